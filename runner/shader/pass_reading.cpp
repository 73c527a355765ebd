#include "shader/pass_reading.hpp"

#include "base/error.hpp"
#include "scene/project_exchange.hpp"
#include "shader/portability.hpp"
#include "shader/rewrite.hpp"
#include "shader/survey.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <unordered_set>

namespace tidemark::glsl {
namespace {

/// Macro that shows a text that it runs in the VS Code extension or, here, in a compatible host.
constexpr std::string_view k_extension_macro = "SHADER_TOY";

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
        // ShaderToy's Sound header has no volumes.
        if (pass.kind == scene::PassKind::sound && kinds[i] == scene::TextureKind::volume)
            kinds[i] = scene::TextureKind::flat;
    }
    return kinds;
}

text::MappedText whole_text(const scene::Scene& scene, const scene::Pass& pass) {
    text::MappedText text;
    if (pass.kind == scene::PassKind::hit)
        text.append_generated(fmt::format("#define {} 1\n", k_hit_macro));
    if (pass.bare_file && pass.text.text().find(k_extension_macro) != std::string::npos)
        text.append_generated(fmt::format("#define {}\n", k_extension_macro));
    if (!pass.definitions.empty())
        text.append_generated(pass.definitions);
    text.append(scene.common);
    text.append(pass.text);
    return text;
}

/// Returns the number of lines that ShaderToy puts before Common and the author's text: six of precisions,
/// then its uniforms, prototypes and `main`.
int site_lines(scene::PassKind kind) {
    switch (kind) {
    case scene::PassKind::buffer: return 27;
    case scene::PassKind::cubemap: return 30;
    case scene::PassKind::sound: return 20;
    default: return 53;
    }
}

/// Makes __LINE__ what it is on ShaderToy, whatever lines Tidemark puts before the author's.
void count_lines_as_site(text::MappedText& source, scene::PassKind kind) {
    constexpr std::string_view k_line = "__LINE__";
    if (source.text().find(k_line) == std::string::npos)
        return;
    int own = 0; // lines before the author's
    while (own < source.line_count() && source.lines().locate(own + 1).file.empty())
        ++own;
    const int by = site_lines(kind) - own;
    std::vector<text::Edit> edits;
    for (const text::Token& token : text::tokenize(source.text()))
        if (token.kind == text::TokenKind::identifier && token.is(k_line))
            edits.push_back({token.begin, token.end(), fmt::format("({} {:+d})", k_line, by)});
    source.apply(edits);
}

} // namespace

PassReading::PassReading(const scene::Scene& scene, const scene::Pass& pass)
    : scene_(scene), pass_(pass), text_(whole_text(scene, pass)), tokens_(text::tokenize(text_.text())),
      preprocessed_(preprocess(tokens_)), facts_(survey(tokens_, preprocessed_, pass.kind, scene.knobs)) {}

std::vector<Dialect> PassReading::dialects(Precision precision) const {
    const ChannelKinds channels = channel_kinds(scene_, pass_);
    const std::vector<MainPlace> places = places_to_try(facts_, pass_.kind);
    const bool overloads = overloads_builtins(tokens_, preprocessed_);
    std::vector<Dialect> dialects;
    if (precision != Precision::single) {
        for (const MainPlace place : places)
            dialects.push_back({Version::core_450, place, true, channels, precision});
        dialects.push_back({Version::core_330, places.front(), true, channels, precision});
        if (overloads)
            dialects.push_back({Version::core_450, places.front(), true, channels, precision, true});
        if (precision == Precision::promoted)
            dialects.push_back(
                {Version::core_450, places.front(), true, channels, Precision::promoted_whole});
        return dialects;
    }
    for (const MainPlace place : places)
        dialects.push_back({Version::core_330, place, true, channels});
    for (const Version version : {Version::core_450, Version::es_300})
        dialects.push_back({version, places.front(), true, channels});
    if (overloads)
        dialects.push_back({Version::core_330, places.front(), true, channels, Precision::single, true});
    dialects.push_back({Version::core_330, places.front(), false, channels});
    return dialects;
}

Result<Assembly> PassReading::assemble(const Dialect& dialect) const {
    const Wrapper ours = wrapper(pass_, facts_, dialect);
    const Rewriting changes = rewrite(text_.text(), tokens_, preprocessed_, facts_, dialect);
    text::MappedText body;
    body.append_generated(prologue(scene_, pass_, facts_, dialect));
    body.append_generated(changes.functions);
    if (dialect.main == MainPlace::first)
        body.append_generated(ours.prototype + ours.main);
    text::MappedText author = text_;
    author.apply(changes.edits);
    body.append(author);
    if (dialect.main != MainPlace::first)
        body.append_generated("\n" + ours.main); // the author's last line may end in a backslash
    if (dialect.initialise)
        start_at_zero(body, dialect.version);
    Assembly result;
    result.source.append_generated(version_lines(dialect, changes.extensions));
    if (dialect.precision != Precision::single) {
        auto promoted = TRY(promote(std::move(body), dialect.precision == Precision::promoted_whole));
        result.source.append_generated(promoted.functions);
        body = std::move(promoted.body);
        result.hashes = std::move(promoted.hashes);
    }
    result.source.append(body);
    count_lines_as_site(result.source, pass_.kind);
    return result;
}

std::optional<SourceLocation> PassReading::place_of(std::string_view name) const {
    const auto found = std::ranges::find_if(tokens_, [&](const text::Token& token) {
        return token.kind == text::TokenKind::identifier && token.is(name);
    });
    if (found == tokens_.end())
        return std::nullopt;
    return text_.lines().locate(found->line, found->column);
}

bool PassReading::defines_function(std::string_view name) const {
    const std::vector<size_t>& code = preprocessed_.code;
    for (size_t i = 1; i + 1 < code.size(); ++i) {
        const text::Token& before = tokens_[code[i - 1]];
        if (tokens_[code[i]].is(name) && tokens_[code[i + 1]].is("(") &&
            before.kind == text::TokenKind::identifier && !before.is("return") && !before.is("else"))
            return true;
    }
    return false;
}

text::MappedText PassReading::site_source() const {
    const Dialect site{Version::es_300, MainPlace::last, false, channel_kinds(scene_, pass_)};
    text::MappedText source;
    source.append_generated(site_prologue(pass_, facts_, site));
    source.append_generated(scene::knobs_as_constants(scene_));
    text::MappedText author = text_;
    author.apply(forms_that_only_the_site_takes());
    source.append(author);
    source.append_generated("\n" + wrapper(pass_, facts_, site).main);
    return source;
}

/// Returns edits for forms that ShaderToy's compiler accepts and Mesa's does not: `packed` as a name,
/// directives among the arguments of a macro, a `#` in a macro that is never used.
std::vector<text::Edit> PassReading::forms_that_only_the_site_takes() const {
    constexpr std::string_view k_word = "packed";
    std::vector<text::Edit> edits = settle_arguments(tokens_, preprocessed_);
    const auto is_used = [&](std::string_view name) {
        return std::ranges::count_if(tokens_, [&](const text::Token& token) { return token.is(name); }) > 1;
    };
    for (const text::Token& token : tokens_)
        if (token.kind == text::TokenKind::identifier && token.is(k_word))
            edits.push_back({token.begin, token.end(), fmt::format("tidemark_{}", k_word)});
    for (const MacroLine& macro : preprocessed_.macros) {
        const auto body = std::span(tokens_).subspan(macro.body, macro.end - macro.body);
        if (std::ranges::any_of(body, [](const text::Token& token) { return token.is("#"); }) &&
            !is_used(macro.name))
            edits.push_back({tokens_[macro.hash].begin, tokens_[macro.end - 1].end(), {}});
    }
    std::ranges::sort(edits, {}, &text::Edit::begin);
    return edits;
}

/// Returns an error with the inactive condition around the entry point, if the text has an entry point there.
std::optional<Diagnostic> PassReading::shut_out(std::string_view entry) const {
    std::vector<size_t> open; // the keyword after the `#` of each enclosing condition
    for (size_t i = 0; i + 1 < tokens_.size(); ++i) {
        if (tokens_[i].is("#") && tokens_[i].first_on_line) {
            const std::string_view word = tokens_[i + 1].text;
            if (word.starts_with("if"))
                open.push_back(i + 1);
            else if (word.starts_with("el") && !open.empty())
                open.back() = i + 1;
            else if (word == "endif" && !open.empty())
                open.pop_back();
        }
        if (!tokens_[i].is(entry) || preprocessed_.activity[i] != Activity::inactive)
            continue;
        const auto shut = std::ranges::find_if(open, [&](size_t word) {
            const size_t behind = text::end_of_directive(tokens_, word - 1);
            return behind < tokens_.size() && preprocessed_.activity[behind] == Activity::inactive;
        });
        if (shut == open.end())
            continue;
        std::string condition = "#";
        std::string hint;
        for (size_t at = *shut; at < text::end_of_directive(tokens_, *shut - 1); ++at) {
            condition += fmt::format("{}{}", at > *shut && !tokens_[at].glued ? " " : "", tokens_[at].text);
            if (pass_.kind == scene::PassKind::hit && tokens_[at].text != k_hit_macro &&
                !nearest_name(tokens_[at].text, {std::string(k_hit_macro)}).empty())
                hint = fmt::format("; did you mean {}?", k_hit_macro);
        }
        return Diagnostic{text_.lines().locate(tokens_[*shut].line, 0), Severity::error,
                          fmt::format("`{}` leaves {} out{}", condition, entry, hint)};
    }
    return std::nullopt;
}

bool PassReading::entry_lacks_parameters() const {
    return facts_.entry_takes_one && facts_.entries.size() == 1 &&
           (pass_.kind == scene::PassKind::image || pass_.kind == scene::PassKind::buffer);
}

/// Looks at code and at the macros that it names; comments and inactive parts do not matter.
std::vector<Diagnostic> PassReading::strange_characters() const {
    const std::string& text = text_.text();
    if (std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80; }))
        return {};
    std::vector<Diagnostic> found;
    const auto look_at = [&](size_t i) {
        const text::Token& token = tokens_[i];
        if (const auto strange = strange_character(std::string_view(text).substr(token.begin));
            strange && !strange->blank)
            found.push_back(
                {text_.lines().locate(token.line, token.column), Severity::error,
                 fmt::format("{} is not a character of GLSL: {}", strange->name, advice_on(*strange))});
    };
    std::unordered_set<std::string_view> names;
    for (const size_t i : preprocessed_.code) {
        look_at(i);
        names.insert(tokens_[i].text);
    }
    std::unordered_set<size_t> seen; // bodies, whose words may name further macros
    for (bool again = true; again;) {
        again = false;
        for (const MacroLine& macro : preprocessed_.macros)
            if (names.contains(macro.name) && seen.insert(macro.hash).second) {
                again = true;
                for (size_t i = macro.body; i < macro.end; ++i) {
                    look_at(i);
                    names.insert(tokens_[i].text);
                }
            }
    }
    return found;
}

std::vector<Diagnostic> PassReading::problems() const {
    if (auto strange = strange_characters(); !strange.empty())
        return strange;
    const std::string_view entry = entry_point(pass_.kind);
    const auto place = [&](size_t token) {
        return text_.lines().locate(tokens_[token].line, tokens_[token].column);
    };
    if (facts_.entries.size() > 1)
        return {
            {place(facts_.entries[1]), Severity::error,
             fmt::format("{} is defined again: put each of ShaderToy's tabs into a file of its own", entry)},
            {place(facts_.entries[0]), Severity::note, "first defined here"}};
    if (facts_.entries.empty() && !facts_.entry_is_macro && !facts_.entry_in_macro && facts_.mains.empty()) {
        if (auto condition = shut_out(entry))
            return {*std::move(condition)};
        return {{pass_.text.lines().locate(1), Severity::error,
                 fmt::format("{} has no {}", pass_.name.empty() ? "the text" : pass_.name, entry)}};
    }
    if (entry_lacks_parameters())
        return {{place(facts_.entries[0]), Severity::error,
                 fmt::format("{} takes two parameters: (out vec4 fragColor, in vec2 fragCoord)", entry)}};
    return {};
}

} // namespace tidemark::glsl
