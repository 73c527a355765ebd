// Textures of a scene's channels, except the outputs of passes. Each distinct input is loaded once, when a
// linked program first reads it. Some inputs change from frame to frame.
#pragma once

#include "base/result.hpp"
#include "gl/texture.hpp"
#include "render/frame_inputs.hpp"
#include "render/last_drawing.hpp"
#include "scene/channel.hpp"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace tidemark::render {

/// Values of the channel uniforms for one channel.
struct ChannelFact {
    std::array<double, 3> resolution{}; ///< iChannelResolution
    double time = 0;                    ///< iChannelTime
    bool loaded = false;                ///< iChN.loaded
};
using ChannelFacts = std::array<ChannelFact, scene::k_channel_count>;

/// Updates a texture; returns true when its content has changed. Empty for a constant texture.
using TextureUpdate = std::function<bool(const gl::Texture&, const FrameInputs&)>;

/// Looped playback, as of music and videos on ShaderToy.
struct Playback {
    double start = 0;    ///< iChannelTime at iTime 0
    double duration = 0; ///< 0: endless

    double time_at(double now) const;
};

class ChannelTextures {
public:
    enum class Index : size_t {};

    /// Returns the texture that `channel` reads, and loads it at the first call. `channel` must not be a
    /// PassOutput. Fails when the file cannot be read or is larger than the driver's limit.
    Result<Index> require(const scene::Channel& channel);

    /// Updates the textures that change with the frame.
    void update(const FrameInputs& inputs);

    const gl::Texture& texture(Index index) const { return entries_[size_t(index)].texture; }
    Generation generation(Index index) const { return entries_[size_t(index)].generation; }
    /// Returns whether `update` may change a texture without user input: music and videos play.
    bool follow_clock() const;
    ChannelFact fact(Index index, const FrameInputs& inputs) const;
    size_t bytes() const;

private:
    struct Entry {
        scene::ChannelInput input;
        bool vflip = true;
        bool mipmaps = false;
        gl::Texture texture;
        TextureUpdate update;
        std::optional<Playback> playback;
        Generation generation = 0;
    };

    std::vector<Entry> entries_;
};

/// Returns the GL sampler of a channel.
gl::SamplerHandle make_sampler(const scene::Sampling& sampling);

} // namespace tidemark::render
