// How a texture is sampled, and what ShaderToy's editor gives each kind of input.
#pragma once

namespace tidemark::scene {

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
/// What the VS Code extension gives what has its first row on top.
inline constexpr Sampling k_unflipped{Filter::linear, Filter::linear, Mipmaps::none, Wrap::repeat, false};
/// Keys are bits: nothing between them.
inline constexpr Sampling k_keyboard_sampling{Filter::nearest, Filter::nearest, Mipmaps::none, Wrap::clamp,
                                              true};

} // namespace tidemark::scene
