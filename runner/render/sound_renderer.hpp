// The sound of a scene: draws its Sound pass as 16-bit stereo samples, for which a context must be current,
// and finds the channels that have a sound.
#pragma once

#include "base/error.hpp"
#include "media/sound_file.hpp"
#include "render/channel_textures.hpp"
#include "render/compiled_scene.hpp"
#include "render/frame_state.hpp"
#include "render/gl_program.hpp"
#include "render/gl_textures.hpp"
#include "scene/scene.hpp"
#include "shader/shader_source.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::render {

class SoundRenderer {
public:
    /// The longest sound, some thirteen hours, because samples are counted in an int, here and in the shader.
    static constexpr double k_longest_seconds = 48'000;

    /// `date` is iDate, without its milliseconds, as on ShaderToy. Fails when the scene has no Sound pass, or
    /// when that does not compile.
    static Result<SoundRenderer> create(const scene::Scene& scene, const Date& date,
                                        glsl::Precision precision = glsl::Precision::single);

    /// Draws the block that starts at sample `first`: left and right interleaved, 44,100 samples a second per
    /// side.
    std::vector<int16_t> draw(int first);
    /// Draws `rows` rows of a block, the first of which starts at sample `first`; the samples equal those of
    /// `draw`.
    std::vector<int16_t> draw_rows(int first, int rows);

    /// Returns the samples per side in so many rows. A block is square.
    static int samples_in(int rows);
    static int block_samples();

private:
    ChannelFacts facts() const;

    std::vector<scene::Knob> knobs_;
    FrameInputs inputs_; ///< only the date is used
    UniformTable uniforms_;
    gl::Program program_;
    gl::VertexArrayHandle no_vertices_;
    gl::RenderTarget target_;
    ChannelTextures textures_;
    std::vector<BoundChannel> channels_;
};

/// The kinds of sound that are taken from a scene.
struct HeardParts {
    bool pass = true;   ///< the Sound pass
    bool inputs = true; ///< `heard_channels`
};

/// A channel that reads a sound file or a video.
struct HeardChannel {
    std::string name; ///< `iChannel0 song.ogg`; of another pass than Image `Buffer A iChannel0 song.ogg`
    std::filesystem::path file;
    bool video = false;
};

/// Returns the channels that have a sound, one for each file. The Sound pass reads no sound, so its own
/// channels are left out.
std::vector<HeardChannel> heard_channels(const scene::Scene& scene);

/// Reads the sound of a channel; nothing for a video without an audio track.
Result<std::optional<sound::InputSound>> read_sound_of(const HeardChannel& channel);

} // namespace tidemark::render
