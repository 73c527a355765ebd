// Draws a scene's Sound pass: samples of 16 bits, stereo, by time. A context must be current.
#pragma once

#include "base/result.hpp"
#include "gl/program.hpp"
#include "gl/render_target.hpp"
#include "render/bound_channel.hpp"
#include "render/channel_textures.hpp"
#include "render/frame_inputs.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <vector>

namespace tidemark::render {

class SoundRenderer {
public:
    /// Fails when the scene has no Sound pass, or one that does not compile.
    static Result<SoundRenderer> create(const scene::Scene& scene);

    /// Left and right in turn, 44100 a second each, of the block that starts at sample `first`.
    std::vector<int16_t> draw(int first, const Date& date);

    /// Samples (of each side) in a block.
    static int block_samples();

private:
    gl::Program program_;
    gl::VertexArrayHandle no_vertices_;
    gl::RenderTarget target_;
    ChannelTextures textures_;
    std::vector<BoundChannel> channels_;
};

} // namespace tidemark::render
