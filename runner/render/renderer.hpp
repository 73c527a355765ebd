// Draws a scene. The only object that does, for a window and for a file alike: give it FrameInputs, get
// pixels. A context must be current, and stay so as long as the Renderer lives.
#pragma once

#include "base/result.hpp"
#include "gl/program.hpp"
#include "gl/render_target.hpp"
#include "image/image.hpp"
#include "render/channel_textures.hpp"
#include "render/frame_inputs.hpp"
#include "render/frame_plan.hpp"
#include "render/uniform_table.hpp"
#include "scene/scene.hpp"

#include <vector>

namespace tidemark::render {

struct RenderOptions {
    Extent extent{640, 360};
    /// u8 draws into RGBA8, so that a picture holds what GL itself shows; f32 into RGBA32F.
    image::SampleType samples = image::SampleType::u8;
};

class Renderer {
public:
    /// Compiles every pass, loads what they read, makes the target. The error of a scene that does not
    /// compile has the authors' own files and lines.
    static Result<Renderer> create(scene::Scene scene, const RenderOptions& options);

    void draw(const FrameInputs& inputs);

    /// The pixels of the last frame drawn.
    image::Image read_back() const;

    /// A target of another size; fails (ErrorCode::usage) beyond the driver's limit and leaves the old one.
    Result<void> resize(Extent extent);

    Extent extent() const { return target_.extent(); }
    const gl::RenderTarget& target() const { return target_; }
    const scene::Scene& scene() const { return scene_; }
    const FramePlan& plan() const { return plan_; }
    const gl::Program& program(size_t pass) const { return passes_[pass].program; }

private:
    struct BoundChannel {
        int unit;
        size_t texture;
        gl::SamplerHandle sampler;
    };
    struct CompiledPass {
        gl::Program program;
        UniformTable uniforms;
        std::vector<BoundChannel> channels;
        ChannelSizes channel_sizes{};
    };

    Result<void> compile();
    Result<void> measure_channels(const scene::Pass& pass, CompiledPass& compiled);
    Result<void> bind_channels();
    void draw_pass(const CompiledPass& pass, const FrameInputs& inputs) const;

    scene::Scene scene_;
    image::SampleType samples_ = image::SampleType::u8;
    gl::VertexArrayHandle no_vertices_;
    std::vector<CompiledPass> passes_; ///< one for each of the scene's
    FramePlan plan_;
    ChannelTextures textures_;
    gl::RenderTarget target_;
};

} // namespace tidemark::render
