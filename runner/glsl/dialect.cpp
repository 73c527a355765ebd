#include "glsl/dialect.hpp"

#include "glsl/prologue.hpp"
#include "glsl/survey.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::glsl {
namespace {

/// The author's text of one pass, read.
struct Reading {
    text::MappedText text;
    std::vector<text::Token> tokens;
    Survey facts;
};

Reading read(const scene::Scene& scene, const scene::Pass& pass) {
    Reading reading{scene.common, {}, {}};
    reading.text.append(pass.text);
    reading.tokens = text::tokenize(reading.text.text());
    reading.facts = survey(reading.tokens, preprocess(reading.tokens), pass.kind);
    return reading;
}

std::vector<MainPlace> places_to_try(const Survey& facts, scene::PassKind kind) {
    std::vector<MainPlace> places;
    if (!facts.mains.empty())
        places.push_back(MainPlace::author);
    const auto wanted = uniforms_of_wrapper(kind);
    if (std::any_of(wanted.begin(), wanted.end(),
                    [&](std::string_view name) { return facts.keeps_uniform(name); }))
        places.push_back(MainPlace::last);
    else if (facts.entry_is_macro || (!facts.entry_is_plain && !facts.entry_in_macro))
        places.insert(places.end(), {MainPlace::last, MainPlace::first});
    else
        places.insert(places.end(), {MainPlace::first, MainPlace::last});
    return places;
}

ChannelKinds channel_kinds(const scene::Scene& scene, const scene::Pass& pass) {
    ChannelKinds kinds{};
    for (size_t i = 0; i < kinds.size(); ++i) {
        kinds[i] = texture_kind(scene, pass.channels[i].input);
        // The site's Sound header knows no volumes.
        if (pass.kind == scene::PassKind::sound && kinds[i] == scene::TextureKind::volume)
            kinds[i] = scene::TextureKind::flat;
    }
    return kinds;
}

} // namespace

std::string to_string(const Dialect& dialect) {
    std::string_view version = dialect.version == Version::core_330   ? "330 core"
                               : dialect.version == Version::core_450 ? "450 core"
                                                                      : "300 es";
    std::string_view main = dialect.main == MainPlace::first  ? ""
                            : dialect.main == MainPlace::last ? ", main last"
                                                              : ", the author's own main";
    return fmt::format("{}{}{}", version, main, dialect.initialise ? "" : ", nothing initialised");
}

std::vector<Dialect> dialects_to_try(const scene::Scene& scene, const scene::Pass& pass) {
    const Survey facts = read(scene, pass).facts;
    const ChannelKinds channels = channel_kinds(scene, pass);
    const std::vector<MainPlace> places = places_to_try(facts, pass.kind);
    std::vector<Dialect> dialects;
    for (const MainPlace place : places)
        dialects.push_back({Version::core_330, place, true, channels});
    for (const Version version : {Version::core_450, Version::es_300})
        dialects.push_back({version, places.front(), true, channels});
    dialects.push_back({Version::core_330, places.front(), false, channels});
    return dialects;
}

std::vector<Diagnostic> entry_point_problems(const scene::Scene& scene, const scene::Pass& pass) {
    const Reading reading = read(scene, pass);
    const Survey& facts = reading.facts;
    const std::string_view entry = entry_point(pass.kind);
    const auto place = [&](size_t token) {
        return reading.text.lines().locate(reading.tokens[token].line, reading.tokens[token].column);
    };
    if (facts.entries.size() > 1)
        return {
            {place(facts.entries[1]), Severity::error,
             fmt::format("{} is defined again: put each of ShaderToy's tabs into a file of its own", entry)},
            {place(facts.entries[0]), Severity::note, "first defined here"}};
    if (facts.entries.empty() && !facts.entry_is_macro && !facts.entry_in_macro && facts.mains.empty())
        return {{pass.text.lines().locate(1), Severity::error,
                 fmt::format("{} has no {}", pass.name.empty() ? "the text" : pass.name, entry)}};
    return {};
}

} // namespace tidemark::glsl
