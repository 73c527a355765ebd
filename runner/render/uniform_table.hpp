// Which of ShaderToy's uniforms a linked program really has, found once, and their values for each frame.
#pragma once

#include "base/extent.hpp"
#include "gl/program.hpp"
#include "render/frame_inputs.hpp"
#include "scene/scene.hpp"

#include <array>
#include <vector>

namespace tidemark::render {

/// What iChannelResolution tells of a channel; zeros where nothing is bound.
using ChannelSizes = std::array<Extent, scene::k_channel_count>;

class UniformTable {
public:
    UniformTable() = default;
    UniformTable(const gl::Reflection& reflection, const std::vector<scene::Knob>& knobs);

    /// Uploads the active uniforms and nothing else.
    void upload(const gl::Program& program, const FrameInputs& inputs, Extent resolution,
                const ChannelSizes& sizes, const std::vector<scene::Knob>& knobs) const;

private:
    enum class Source {
        resolution,
        time,
        time_delta,
        frame,
        frame_rate,
        mouse,
        date,
        sample_rate,
        channel_time,
        channel_resolution,
        camera,
        knob
    };
    struct Entry {
        gl::Uniform uniform;
        Source source;
        size_t knob = 0; ///< index, for Source::knob
    };
    std::vector<Entry> entries_;
};

} // namespace tidemark::render
