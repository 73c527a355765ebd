// The channels of a pass: what `iChannelN` reads and how it is sampled.
#pragma once

#include "base/error.hpp"
#include "scene/channel_input.hpp"
#include "scene/sampling.hpp"

#include <array>

namespace tidemark::scene {

/// `iChannel0` … `iChannel9`, as in the VS Code extension; the site has the first four of them.
inline constexpr int k_channel_count = 10;
inline constexpr int k_site_channel_count = 4;

struct Channel {
    ChannelInput input = Noise{};
    Sampling sampling = k_texture_sampling;
    SourceLocation where{}; ///< the directive that asked for it; empty when nothing did
};

using Channels = std::array<Channel, k_channel_count>;

} // namespace tidemark::scene
