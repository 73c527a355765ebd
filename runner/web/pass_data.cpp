#include "web/pass_data.hpp"

#include "glsl/pass_reading.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <string_view>

namespace tidemark::web {
namespace {

std::string_view name_of(scene::PassKind kind) {
    switch (kind) {
    case scene::PassKind::buffer: return "buffer";
    case scene::PassKind::cubemap: return "cubemap";
    case scene::PassKind::sound: return "sound";
    default: return "image";
    }
}

/// Returns GLSL ES 3.00 without initialisers: WebGL sets variables to zero, as shaders written for it expect.
text::MappedText web_source(const glsl::PassReading& reading) {
    const auto dialects = reading.dialects(glsl::Precision::single);
    glsl::Dialect dialect = *std::ranges::find(dialects, glsl::Version::es_300, &glsl::Dialect::version);
    dialect.initialise = false;
    return std::move(reading.assemble(dialect)->source); // assembling fails only in double precision
}

/// Returns the path relative to the scene, so that a page does not reveal its author's folders.
std::string shown_name(const std::filesystem::path& file, const scene::Scene& scene) {
    const auto relative =
        file.lexically_normal().lexically_relative(scene.file.parent_path().lexically_normal());
    return relative.empty() || *relative.begin() == ".." ? file.filename().string() : relative.string();
}

/// Returns [line of the source, file, line in the file] for each line at which a run of a file begins;
/// generated lines have an empty file.
Json line_runs(const text::MappedText& source, const scene::Scene& scene) {
    Json runs = Json::array();
    SourceLocation last;
    for (int line = 1; line <= source.line_count(); ++line) {
        const SourceLocation here = source.lines().locate(line);
        const bool goes_on = here.file == last.file && (here.file.empty() || here.line == last.line + 1);
        if (line == 1 || !goes_on)
            runs.push_back({line, here.file.empty() ? "" : shown_name(here.file, scene), here.line});
        last = here;
    }
    return runs;
}

} // namespace

Json pass_data(const scene::Scene& scene, const scene::Pass& pass) {
    const glsl::PassReading reading(scene, pass);
    const text::MappedText source = web_source(reading);
    return {{"name", pass.name},
            {"kind", name_of(pass.kind)},
            {"source", source.text()},
            {"lines", line_runs(source, scene)},
            {"discards", reading.discards()},
            {"foreign", pass.bare_file || reading.has_own_main()}};
}

std::vector<size_t> channels_named(const scene::Scene& scene, const scene::Pass& pass) {
    const glsl::PassReading reading(scene, pass);
    const auto named = [&](std::string_view name) { return reading.place_of(name).has_value(); };
    // Sizes and times are indexed by a number that only a compiler can evaluate, so the first four count.
    const bool asks = named("iChannelResolution") || named("iChannelTime") || named("iChannel");
    std::vector<size_t> channels;
    for (size_t i = 0; i < scene::k_channel_count; ++i)
        if ((asks && i < scene::k_site_channel_count) || named(fmt::format("iChannel{}", i)) ||
            named(fmt::format("iCh{}", i)))
            channels.push_back(i);
    return channels;
}

} // namespace tidemark::web
