// Which GLSL to offer the driver. ShaderToy's texts are written for WebGL 2; a desktop driver takes nearly
// all of them as `330 core`, and most of the rest in another version or with our `main` in another place.
// Pure text.
#pragma once

#include "scene/scene.hpp"
#include "text/mapped_text.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// What `#version` says, in the order of our trust: see runner/scene/README.md, "Dialect".
enum class Version { core_330, core_450, es_300 };

/// What the author's floats are.
enum class Precision {
    single,
    promoted,      ///< doubles, but for hashes (glsl/double/float_hashes.hpp)
    promoted_whole ///< doubles, hashes too
};

/// Where the `main` stands that calls the author's entry point.
enum class MainPlace {
    first, ///< before the text, so that the author's macros do not reach it
    last,  ///< behind the text: for an entry point that is a macro
    author ///< the text has a `main` of its own
};

using ChannelKinds = std::array<scene::TextureKind, scene::k_channel_count>;

/// One way to present a pass to the driver.
struct Dialect {
    Version version = Version::core_330;
    MainPlace main = MainPlace::first;
    bool initialise = true; ///< what has no value starts at zero: glsl/initialise.hpp
    ChannelKinds channels{};
    Precision precision = Precision::single;
    bool joins_overloads = false; ///< functions named as built-in ones stand beside them: glsl/overloads.hpp
    /// gl_FragCoord counts from the corner of the whole picture, wherever in it the target lies: the host
    /// sets `vec2 tidemark_tile`, in pixels.
    bool tiled = false;
    /// A pixel of Image that is not finite, which bytes cannot hold, has the alpha of
    /// image::k_non_finite_alpha instead of 1.
    bool marks_non_finite = false;
    /// Image has the alpha that its text gives it, instead of 1.
    bool keeps_alpha = false;

    bool operator==(const Dialect&) const = default;
};

/// "330 core", with what else is unusual: "300 es, main last".
std::string to_string(const Dialect& dialect);

/// After the driver refused `source` with `log`: kinds for the channels that nobody specified, the likeliest
/// first, cubes before volumes. Empty when the log does not complain about samplers.
std::vector<ChannelKinds> channel_kinds_to_try(const scene::Scene& scene, const scene::Pass& pass,
                                               const text::MappedText& source, std::string_view log);

} // namespace tidemark::glsl
