// Textures and samplers of channels: live media, loaded inputs, and their binding.
//
// The current sound and picture of a window, for the inputs of a scene that have no file.
#pragma once

#include "base/error.hpp"
#include "media/image.hpp"
#include "media/spectrum.hpp"
#include "render/frame_state.hpp"
#include "render/gl_program.hpp"
#include "render/gl_textures.hpp"
#include "render/pass_state.hpp"
#include "scene/channel.hpp"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace tidemark::render {

struct LiveMedia {
    std::optional<sound::SignalBytes> microphone{};
    std::shared_ptr<const image::Image> webcam{}; ///< image::k_camera_extent, the bottom row first
};

// Textures of a scene's channels, except the outputs of passes. Each distinct input is loaded once, when a
// linked program first reads it. Some inputs change from frame to frame.

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

// Connects a channel of a linked program to a texture unit and a sampler.

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
