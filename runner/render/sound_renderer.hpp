// Draws a scene's Sound pass: samples of 16 bits, stereo, by time. A context must be current.
#pragma once

#include "base/result.hpp"
#include "gl/program.hpp"
#include "gl/render_target.hpp"
#include "glsl/dialect.hpp"
#include "render/bound_channel.hpp"
#include "render/channel_textures.hpp"
#include "render/frame_inputs.hpp"
#include "render/uniform_table.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <vector>

namespace tidemark::render {

class SoundRenderer {
public:
    /// Samples are counted in an int, here and in the shader: some thirteen hours.
    static constexpr double k_longest_seconds = 48'000;

    /// `date` is iDate; without milliseconds, as on the site. Fails when the scene has no Sound pass, or one
    /// that does not compile.
    static Result<SoundRenderer> create(const scene::Scene& scene, const Date& date,
                                        glsl::Precision precision = glsl::Precision::single);

    /// Left and right in turn, 44100 a second each, of the block that starts at sample `first`.
    std::vector<int16_t> draw(int first);
    /// Of so many rows of a block, the first one starting at sample `first`: the same numbers.
    std::vector<int16_t> draw_rows(int first, int rows);

    /// Samples (of each side) in a row, of which a block has as many.
    static int samples_in(int rows);
    static int block_samples();

private:
    ChannelFacts facts() const;

    std::vector<scene::Knob> knobs_;
    FrameInputs inputs_; ///< the date only
    UniformTable uniforms_;
    gl::Program program_;
    gl::VertexArrayHandle no_vertices_;
    gl::RenderTarget target_;
    ChannelTextures textures_;
    std::vector<BoundChannel> channels_;
};

} // namespace tidemark::render
