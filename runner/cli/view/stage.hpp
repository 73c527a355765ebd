// A Renderer with the OpenGL context that it lives in: made and warmed up on any thread, then drawn on the
// window's.
#pragma once

#include "platform/window_context.hpp"
#include "render/renderer.hpp"

#include <memory>

namespace tidemark::cli {

class Stage {
public:
    /// Compiles the scene and has the driver finish what it puts off until the first draw. The context is
    /// current on the calling thread meanwhile, and nowhere afterwards.
    static Result<Stage> create(platform::WindowContext context, scene::Scene scene,
                                const render::RenderOptions& options, const render::FrameInputs& first);
    Stage(Stage&&) = default;
    Stage& operator=(Stage&&) = delete;
    /// What is current on the calling thread stays so.
    ~Stage();

    /// On the window's thread: what is drawn from now on is for the window.
    Result<void> enter() { return context_.make_current_in_window(); }

    render::Renderer& renderer() { return *renderer_; }
    const render::Renderer& renderer() const { return *renderer_; }

private:
    Stage(platform::WindowContext context, std::unique_ptr<render::Renderer> renderer)
        : context_(std::move(context)), renderer_(std::move(renderer)) {}

    platform::WindowContext context_;
    std::unique_ptr<render::Renderer> renderer_;
};

} // namespace tidemark::cli
