// Sampling parameters of textures, and the defaults of ShaderToy's editor for each kind of input.
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

/// ShaderToy's default for a texture: mipmaps, repeat, flipped.
inline constexpr Sampling k_texture_sampling{Filter::linear, Filter::linear, Mipmaps::linear, Wrap::repeat,
                                             true};

/// ShaderToy's default for a buffer.
inline constexpr Sampling k_buffer_sampling{Filter::linear, Filter::linear, Mipmaps::none, Wrap::clamp, true};
/// ShaderToy's default for a cubemap.
inline constexpr Sampling k_cubemap_sampling{Filter::linear, Filter::linear, Mipmaps::none, Wrap::clamp,
                                             false};

/// ShaderToy's default for a volume.
inline constexpr Sampling k_volume_sampling{Filter::linear, Filter::linear, Mipmaps::linear, Wrap::repeat,
                                            false};
/// The VS Code extension's default for data with its first row on top.
inline constexpr Sampling k_unflipped{Filter::linear, Filter::linear, Mipmaps::none, Wrap::repeat, false};
/// Keys are bits, so they are not interpolated.
inline constexpr Sampling k_keyboard_sampling{Filter::nearest, Filter::nearest, Mipmaps::none, Wrap::clamp,
                                              true};

} // namespace tidemark::scene
