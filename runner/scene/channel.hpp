// Inputs of a pass: what `iChannelN` reads and how it is sampled. Values only; nothing is loaded here.
#pragma once

#include "base/error.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <variant>
#include <vector>

namespace tidemark::scene {

/// `iChannel0` … `iChannel9`, as in the VS Code extension; the site has the first four of them.
inline constexpr int k_channel_count = 10;
inline constexpr int k_site_channel_count = 4;

enum class Filter { nearest, linear };
enum class Mipmaps { none, nearest, linear };
enum class Wrap { repeat, clamp, mirror };

struct Sampling {
    Filter magnify = Filter::linear;
    Filter minify = Filter::linear;
    Mipmaps mipmaps = Mipmaps::none;
    Wrap wrap = Wrap::repeat;
    bool vflip = true; ///< t = 0 is the bottom row of the picture; false: its top row

    bool operator==(const Sampling&) const = default;
};

/// What ShaderToy's editor gives a texture: mipmaps, repeat, flipped.
inline constexpr Sampling k_texture_sampling{Filter::linear, Filter::linear, Mipmaps::linear, Wrap::repeat,
                                             true};

/// What ShaderToy's editor gives a buffer.
inline constexpr Sampling k_buffer_sampling{Filter::linear, Filter::linear, Mipmaps::none, Wrap::clamp, true};
/// What ShaderToy's editor gives a cubemap.
inline constexpr Sampling k_cubemap_sampling{Filter::linear, Filter::linear, Mipmaps::none, Wrap::clamp,
                                             false};

/// What ShaderToy's editor gives a volume.
inline constexpr Sampling k_volume_sampling{Filter::linear, Filter::linear, Mipmaps::linear, Wrap::repeat,
                                            false};
/// Keys are bits: nothing between them.
inline constexpr Sampling k_keyboard_sampling{Filter::nearest, Filter::nearest, Mipmaps::none, Wrap::clamp,
                                              true};

/// The kind of sampler that GLSL needs for an input.
enum class TextureKind { flat, cube, volume };

/// Nothing: reads give black. The kind is that of the sampler: a read of a cubemap pass that the project
/// lacks still is a read of a cube.
struct Unbound {
    TextureKind kind = TextureKind::flat;
    bool operator==(const Unbound&) const = default;
};

/// Textures of noise that we generate (image/made/noise.hpp): stand-ins for ShaderToy's with the same size,
/// number of channels and structure.
enum class NoiseKind {
    rgba_256,
    rgba_64,
    grey_256,
    grey_64,
    blue_1024,
    bayer_8,
    grey_volume_32,
    rgba_volume_32
};
struct Noise {
    NoiseKind kind = NoiseKind::rgba_256;
    bool operator==(const Noise&) const = default;
};

/// A picture file.
struct Picture {
    std::filesystem::path file;
    bool one_channel = false; ///< one of ShaderToy's media that is red alone there, whatever the file holds
    bool operator==(const Picture&) const = default;
};

/// What a pass of the scene drew: a buffer, or the cube of a cubemap pass. Whether that is this frame's or
/// the last one's follows from the order of the passes (render/frame_plan.hpp).
struct PassOutput {
    size_t pass = 0; ///< index into Scene::passes
    bool operator==(const PassOutput&) const = default;
};

/// Six square faces (+x -x +y -y +z -z), or one file: a cross or an equirectangular panorama.
struct Cubemap {
    std::vector<std::filesystem::path> files;
    bool operator==(const Cubemap&) const = default;
};

/// ShaderToy's `.bin` volume.
struct Volume {
    std::filesystem::path file;
    bool operator==(const Volume&) const = default;
};

/// 256 columns by JavaScript key code: down, pressed in this frame, toggled; and, of the texture that
/// `#iKeyboard` means, a fourth row: released in this frame.
struct Keyboard {
    int rows = 3;
    bool operator==(const Keyboard&) const = default;
};

/// Spectrum and wave of a sound file, 512 x 2; without a file the site's own signal for a silent input.
struct Music {
    std::filesystem::path file;
    bool operator==(const Music&) const = default;
};

/// Frames of a video file.
struct Video {
    std::filesystem::path file;
    bool operator==(const Video&) const = default;
};

/// A generated picture, cube or volume of the same kind and size in the place of one that is not to be had.
struct StandIn {
    enum class Kind { picture, cubemap, volume };
    Kind kind = Kind::picture;
    int width = 512;
    int height = 512;
    int channels = 4;
    bool operator==(const StandIn&) const = default;
};

/// A picture of one value: what a test looks at a scene with.
struct Constant {
    enum class Kind { black, white, nan, texel }; ///< texel: a single grey one
    Kind kind = Kind::black;
    bool operator==(const Constant&) const = default;
};

using ChannelInput = std::variant<Unbound, Noise, Picture, PassOutput, Cubemap, Volume, Keyboard, Music,
                                  Video, StandIn, Constant>;

struct Channel {
    ChannelInput input = Noise{};
    Sampling sampling = k_texture_sampling;
    SourceLocation where{}; ///< the directive that asked for it; empty when nothing did
};

using Channels = std::array<Channel, k_channel_count>;

} // namespace tidemark::scene
