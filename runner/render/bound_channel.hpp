// A channel of a linked program: which texture stands at which unit, and how it is sampled there.
#pragma once

#include "base/result.hpp"
#include "gl/program.hpp"
#include "render/channel_textures.hpp"
#include "scene/channel.hpp"

#include <variant>

namespace tidemark::render {

/// Where the texture of `#iKeyboard` stands: behind iChannel0 to iChannel3.
inline constexpr int k_keyboard_unit = scene::k_channel_count;

struct BoundChannel {
    int unit = 0;
    gl::SamplerHandle sampler;
    std::variant<ChannelTextures::Index, scene::PassOutput> source;
};

/// Makes what `channel` reads ready in `textures`, unless a pass draws it, and tells the program's samplers
/// of that unit (`iChannelN`, `iChN.sampler`, `iKeyboard`) where to look. Fails like
/// ChannelTextures::require.
Result<BoundChannel> make_channel(const gl::Program& program, int unit, const scene::Channel& channel,
                                  ChannelTextures& textures);

/// The same for the samplers of another program alone.
void point_samplers(const gl::Program& program, int unit);

/// For the next draws.
void bind(const BoundChannel& channel, const gl::Texture& texture);

} // namespace tidemark::render
