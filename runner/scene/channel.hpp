// Inputs of a pass: what `iChannelN` reads and how it is sampled. Values only; nothing is loaded here.
#pragma once

#include "base/error.hpp"

#include <array>
#include <filesystem>
#include <variant>

namespace tidemark::scene {

/// `iChannel0` … `iChannel3`.
inline constexpr int k_channel_count = 4;

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

/// Nothing: reads give black.
struct Unbound {
    bool operator==(const Unbound&) const = default;
};
/// The generated 256 x 256 RGBA noise (image/noise.hpp).
struct Noise {
    bool operator==(const Noise&) const = default;
};
/// A picture file.
struct Picture {
    std::filesystem::path file;
    bool operator==(const Picture&) const = default;
};

using ChannelInput = std::variant<Unbound, Noise, Picture>;

struct Channel {
    ChannelInput input = Noise{};
    Sampling sampling = k_texture_sampling;
    SourceLocation where{}; ///< the directive that asked for it; empty when nothing did
};

using Channels = std::array<Channel, k_channel_count>;

} // namespace tidemark::scene
