// A Renderer with the OpenGL context that it lives in: made and warmed up on any thread, then drawn on the
// window's. A scene's first one compiles the author's text as it is; a settled one is its quicker twin.
#pragma once

#include "platform/output_window.hpp"
#include "platform/window_context.hpp"
#include "render/renderer.hpp"

#include <memory>
#include <optional>

namespace tidemark::cli {

class Stage {
public:
    /// Compiles the scene and has the driver finish what it puts off until the first draw. The context is
    /// current on the calling thread meanwhile, and nowhere afterwards.
    static Result<Stage> create(platform::WindowContext context, scene::Scene scene,
                                const render::RenderOptions& options, const render::FrameInputs& first);
    /// The same scene by a specialised program, if there is one that draws the same bytes in frame 0 and in
    /// `shown` and takes clearly less time: else it fails, and there is nothing to tell anybody.
    static Result<Stage> settle(platform::WindowContext context, const scene::Scene& scene,
                                const render::RenderOptions& options, const render::FrameInputs& shown);
    Stage(Stage&&) = default;
    Stage& operator=(Stage&&) = delete;
    /// What is current on the calling thread stays so.
    ~Stage();

    /// On the window's thread: what is drawn from now on is for the window.
    Result<void> enter() { return context_.make_current_in_window(); }

    /// Likewise, for a second window until `enter`.
    Result<void> enter(platform::OutputWindow& output) { return output.make_current(context_); }

    render::Renderer& renderer() { return *renderer_; }
    const render::Renderer& renderer() const { return *renderer_; }

    /// For how many seconds nobody should touch the scene before it is worth the work to settle it; none
    /// where there is nothing to gain.
    std::optional<double> seconds_to_settle() const { return seconds_to_settle_; }
    /// What a frame of a settled one takes of the plain one's time.
    std::optional<double> share() const { return share_; }

private:
    Stage(platform::WindowContext context, std::unique_ptr<render::Renderer> renderer)
        : context_(std::move(context)), renderer_(std::move(renderer)) {}

    platform::WindowContext context_;
    std::unique_ptr<render::Renderer> renderer_;
    std::optional<double> seconds_to_settle_;
    std::optional<double> share_;
};

} // namespace tidemark::cli
