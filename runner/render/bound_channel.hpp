// Connects a channel of a linked program to a texture unit and a sampler.
#pragma once

#include "base/result.hpp"
#include "gl/program.hpp"
#include "render/channel_textures.hpp"
#include "scene/channel.hpp"

#include <variant>

namespace tidemark::render {

/// The texture unit of `#iKeyboard`: the first one after those of the channels.
inline constexpr int k_keyboard_unit = scene::k_channel_count;

struct BoundChannel {
    int unit = 0;
    gl::SamplerHandle sampler;
    std::variant<ChannelTextures::Index, scene::PassOutput> source;
};

/// Loads the input of `channel` into `textures`, unless a pass draws it, and sets the program's samplers
/// (`iChannelN`, `iChN.sampler`, `iKeyboard`) to that unit. Fails like ChannelTextures::require.
Result<BoundChannel> make_channel(const gl::Program& program, int unit, const scene::Channel& channel,
                                  ChannelTextures& textures);

/// Sets only the samplers, in a program.
void point_samplers(const gl::Program& program, int unit);

/// Binds texture and sampler for the next draws.
void bind(const BoundChannel& channel, const gl::Texture& texture);

} // namespace tidemark::render
