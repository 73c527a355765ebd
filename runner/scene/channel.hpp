// The channels of a pass: what `iChannelN` reads and how it is sampled.
#pragma once

#include "base/error.hpp"
#include "scene/channel_input.hpp"
#include "scene/sampling.hpp"

#include <array>

namespace tidemark::scene {

/// `iChannel0` … `iChannel9`, as in the VS Code extension; ShaderToy has the first four.
inline constexpr int k_channel_count = 10;
inline constexpr int k_site_channel_count = 4;

struct Channel {
    ChannelInput input = Noise{};
    Sampling sampling = k_texture_sampling;
    SourceLocation where{}; ///< the directive that set the input; empty if none did
};

using Channels = std::array<Channel, k_channel_count>;

} // namespace tidemark::scene
