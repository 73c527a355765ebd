#include "shader/shader_source.hpp"

#include "base/tokens.hpp"
#include "shader/driver_log.hpp"
#include "shader/pass_reading.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <set>

namespace tidemark::glsl {

std::string to_string(const Dialect& dialect) {
    std::string_view version = dialect.version == Version::core_330   ? "330 core"
                               : dialect.version == Version::core_450 ? "450 core"
                                                                      : "300 es";
    std::string_view main = dialect.main == MainPlace::first  ? ""
                            : dialect.main == MainPlace::last ? ", main last"
                                                              : ", the author's own main";
    std::string_view precision = dialect.precision == Precision::single ? ""
                                 : dialect.precision == Precision::promoted
                                     ? ", in double precision"
                                     : ", in double precision, hashes too";
    return fmt::format("{}{}{}{}{}", version, main, dialect.initialise ? "" : ", nothing initialised",
                       precision, dialect.joins_overloads ? ", built-in functions overloaded" : "");
}

namespace {

using scene::TextureKind;

constexpr size_t k_channels = scene::k_channel_count;
using Chosen = std::array<bool, k_channels>;

/// Returns the channels whose input is unknown: no directive and no JSON, or JSON that has lost it.
Chosen unspecified(const scene::Pass& pass) {
    Chosen chosen{};
    for (size_t i = 0; i < k_channels; ++i)
        chosen[i] = pass.channels[i].where.file.empty() &&
                    (!traits_of(pass.channels[i].input).loaded ||
                     pass.channels[i].input == scene::ChannelInput(scene::Noise{}));
    return chosen;
}

/// Recognises errors such as `no matching function for call to `texture(sampler2D, vec3)'`: a call with a
/// sampler of the wrong kind.
bool complains_of_sampler(std::string_view message) {
    const bool refused = message.find("no matching") != std::string_view::npos ||
                         message.find("No matching") != std::string_view::npos ||
                         message.find("no overload") != std::string_view::npos ||
                         message.find("unable to find compatible") != std::string_view::npos;
    return refused && (message.find("sampler") != std::string_view::npos ||
                       message.find("texture") != std::string_view::npos ||
                       message.find("texelFetch") != std::string_view::npos);
}

/// Returns the lines of such errors, in the text that was passed to the driver.
std::set<int> lines_of_complaints(std::string_view log, const text::MappedText& source) {
    text::MappedText same; // maps each line to itself
    same.append(source.text(), "driver", 1);
    std::set<int> lines;
    for (const DriverMessage& message : parse_driver_log(log, same))
        if (complains_of_sampler(message.diagnostic.message))
            lines.insert(message.diagnostic.where.line);
    return lines;
}

int channel_of(std::string_view word) {
    for (size_t i = 0; i < k_channels; ++i)
        if (word == k_channel_names[i] || (i < k_channel_structs.size() && word == k_channel_structs[i]))
            return int(i);
    return -1;
}

struct Mentions {
    Chosen complained_of{}; ///< named in a line with such an error
    Chosen used{};          ///< named anywhere except in generated lines
};

Mentions mentions(const text::MappedText& source, const std::set<int>& lines) {
    Mentions found;
    for (const text::Token& token : text::tokenize(source.text())) {
        const int channel = token.text.starts_with("iCh") ? channel_of(token.text) : -1;
        if (channel < 0 || source.lines().locate(token.line).file.empty())
            continue;
        found.used[size_t(channel)] = true;
        if (lines.contains(token.line))
            found.complained_of[size_t(channel)] = true;
    }
    return found;
}

/// Returns all ways to change the kinds of the first suspects, those with most changes first, cubes before
/// volumes.
std::vector<ChannelKinds> combinations(std::vector<size_t> suspects) {
    constexpr size_t k_most_suspects = 4; // ShaderToy has four channels: 81 combinations
    suspects.resize(std::min(suspects.size(), k_most_suspects));
    constexpr TextureKind k_order[] = {TextureKind::cube, TextureKind::volume, TextureKind::flat};
    size_t count = 1;
    for (size_t i = 0; i < suspects.size(); ++i)
        count *= std::size(k_order);
    std::vector<ChannelKinds> all;
    for (size_t number = 0; number + 1 < count; ++number) { // the last combination is all flat
        ChannelKinds kinds{};
        size_t rest = number;
        for (const size_t suspect : suspects) {
            kinds[suspect] = k_order[rest % std::size(k_order)];
            rest /= std::size(k_order);
        }
        all.push_back(kinds);
    }
    const auto flat = [](const ChannelKinds& kinds) {
        return std::count(kinds.begin(), kinds.end(), TextureKind::flat);
    };
    std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return flat(a) < flat(b); });
    return all;
}

} // namespace

std::vector<ChannelKinds> channel_kinds_to_try(const scene::Scene& scene, const scene::Pass& pass,
                                               const text::MappedText& source, std::string_view log) {
    const std::set<int> lines = lines_of_complaints(log, source);
    if (lines.empty())
        return {};
    const Mentions named = mentions(source, lines);
    const Chosen open = unspecified(pass);
    const auto both = [&](const Chosen& named_channels) {
        std::vector<size_t> channels;
        for (size_t i = 0; i < k_channels; ++i)
            if (open[i] && named_channels[i])
                channels.push_back(i);
        return channels;
    };
    // Channels named in the failing lines come first. A macro or parameter may hide the name, so any used
    // channel is possible.
    std::vector<ChannelKinds> candidates = combinations(both(named.complained_of));
    for (const ChannelKinds& kinds : combinations(both(named.used)))
        if (std::find(candidates.begin(), candidates.end(), kinds) == candidates.end())
            candidates.push_back(kinds);
    for (ChannelKinds& kinds : candidates)
        for (size_t i = 0; i < k_channels; ++i)
            if (!open[i])
                kinds[i] = texture_kind(scene, pass.channels[i].input);
    constexpr size_t k_most = 24; // each costs a compilation
    candidates.resize(std::min(candidates.size(), k_most));
    return candidates;
}

ShaderSource assemble(const scene::Scene& scene, const scene::Pass& pass) {
    const PassReading reading(scene, pass);
    return std::move(reading.assemble(reading.dialects(Precision::single).front())->source);
}

ShaderSource assemble(const scene::Scene& scene, const scene::Pass& pass, const Dialect& dialect) {
    assert(dialect.precision == Precision::single);
    return std::move(PassReading(scene, pass).assemble(dialect)->source);
}

const char* const k_vertex_shader = R"(#version 330 core
uniform vec2 tidemark_tile;
flat out vec2 tidemark_corner;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
    tidemark_corner = tidemark_tile;
}
)";

const char* vertex_shader(Version version) {
    return version != Version::es_300 ? k_vertex_shader : R"(#version 300 es
uniform vec2 tidemark_tile;
flat out vec2 tidemark_corner;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
    tidemark_corner = tidemark_tile;
}
)";
}

} // namespace tidemark::glsl
