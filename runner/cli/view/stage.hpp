// A Renderer with its OpenGL context: created and warmed up on any thread, then drawn on the window's. The
// first one of a scene compiles the text as written; after idle time it may be replaced by an optimised
// program with identical output.
#pragma once

#include "platform/shared_context.hpp"
#include "render/renderer.hpp"

#include <memory>
#include <optional>

namespace tidemark::cli {

class Stage {
public:
    /// Compiles the scene and makes the driver finish what it defers to the first draw. Meanwhile the context
    /// is current on the calling thread; afterwards on none.
    static Result<Stage> create(platform::SharedContext context, scene::Scene scene,
                                const render::RenderOptions& options, const render::FrameInputs& first);
    /// Returns an optimised program of the same scene that draws the same bytes in frame 0 and in `shown` and
    /// takes clearly less time; fails if there is none, which need not be reported.
    static Result<Stage> settle(platform::SharedContext context, const scene::Scene& scene,
                                const render::RenderOptions& options, const render::FrameInputs& shown);
    Stage(Stage&&) = default;
    Stage& operator=(Stage&&) = delete;
    /// Keeps the calling thread's current context.
    ~Stage();

    /// Makes the context current on the window's thread, to draw into the window.
    Result<void> enter() { return context_.make_current_in_window(); }

    render::Renderer& renderer() { return *renderer_; }
    const render::Renderer& renderer() const { return *renderer_; }

    /// Returns the idle time, in seconds, before background optimisation is worth trying; none: it never is.
    std::optional<double> seconds_to_settle() const { return seconds_to_settle_; }
    /// Returns the frame time of an optimised program as a share of the original's.
    std::optional<double> share() const { return share_; }

private:
    Stage(platform::SharedContext context, std::unique_ptr<render::Renderer> renderer)
        : context_(std::move(context)), renderer_(std::move(renderer)) {}

    platform::SharedContext context_;
    std::unique_ptr<render::Renderer> renderer_;
    std::optional<double> seconds_to_settle_;
    std::optional<double> share_;
};

} // namespace tidemark::cli
