// The GLSL variants in which a pass can be passed to the driver. ShaderToy's texts are written for WebGL 2;
// desktop drivers accept nearly all of them as `330 core`, and most others in another version or with `main`
// in another place. Text only.
#pragma once

#include "scene/scene.hpp"
#include "text/mapped_text.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Values of `#version`, preferred ones first: see runner/scene/README.md, "Dialect".
enum class Version { core_330, core_450, es_300 };

/// Precision of the author's floats.
enum class Precision {
    single,
    promoted,      ///< doubles, except in hashes (find_float_regions)
    promoted_whole ///< doubles, in hashes too
};

/// Position of the `main` that calls the author's entry point.
enum class MainPlace {
    first, ///< before the text, so that the author's macros do not change it
    last,  ///< after the text, for an entry point that is a macro
    author ///< the text has its own `main`
};

using ChannelKinds = std::array<scene::TextureKind, scene::k_channel_count>;

/// One way to present a pass to the driver.
struct Dialect {
    Version version = Version::core_330;
    MainPlace main = MainPlace::first;
    bool initialise = true; ///< variables without a value start at zero: start_at_zero()
    ChannelKinds channels{};
    Precision precision = Precision::single;
    bool joins_overloads = false; ///< functions named like built-in ones overload them: join_overloads()
    /// gl_FragCoord is relative to the corner of the whole picture, not of the target: the host sets `vec2
    /// tidemark_tile`, in pixels.
    bool tiled = false;
    /// A NaN or infinite pixel of Image, which bytes cannot hold, gets the alpha image::k_non_finite_alpha
    /// instead of 1.
    bool marks_non_finite = false;
    /// Image keeps the alpha that its text writes, instead of 1.
    bool keeps_alpha = false;

    bool operator==(const Dialect&) const = default;
};

/// Returns "330 core" followed by what differs from the default: "300 es, main last".
std::string to_string(const Dialect& dialect);

/// Call after the driver rejected `source` with `log`. Returns kinds for the channels whose input is
/// unspecified, the likeliest first, cubes before volumes; empty if the log has no error about samplers.
std::vector<ChannelKinds> channel_kinds_to_try(const scene::Scene& scene, const scene::Pass& pass,
                                               const text::MappedText& source, std::string_view log);

} // namespace tidemark::glsl
