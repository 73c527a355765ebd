// The textures behind a scene's channels, other than what its passes draw: each distinct input is made or
// loaded once, and only when a linked program reads it. Some change from frame to frame.
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

/// What the channel uniforms tell of one channel.
struct ChannelFact {
    std::array<double, 3> resolution{}; ///< iChannelResolution
    double time = 0;                    ///< iChannelTime
    bool loaded = false;                ///< iChN.loaded
};
using ChannelFacts = std::array<ChannelFact, scene::k_channel_count>;

/// Brings a texture up to date; true when its content is another now. Empty: it never is.
using TextureUpdate = std::function<bool(const gl::Texture&, const FrameInputs&)>;

/// What plays again and again, as music and videos do on the site.
struct Playback {
    double start = 0;    ///< iChannelTime at iTime 0
    double duration = 0; ///< 0: it has no end

    double time_at(double now) const;
};

class ChannelTextures {
public:
    enum class Index : size_t {};

    /// The texture that `channel` reads, made when it is the first to do so. Not for a PassOutput. Fails when
    /// its file cannot be read or is larger than the driver takes.
    Result<Index> require(const scene::Channel& channel);

    /// Brings the textures that change with the frame up to date.
    void update(const FrameInputs& inputs);

    const gl::Texture& texture(Index index) const { return entries_[size_t(index)].texture; }
    Generation generation(Index index) const { return entries_[size_t(index)].generation; }
    /// Whether `update` may change something although nobody did anything: music and videos play.
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

/// The GL sampler of a channel.
gl::SamplerHandle make_sampler(const scene::Sampling& sampling);

} // namespace tidemark::render
