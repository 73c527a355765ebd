// A Renderer with its OpenGL context: created and warmed up on any thread, then drawn on the window's. The
// first one of a scene compiles the text as written; after idle time it may be replaced by an optimised
// program with identical output.
#pragma once

#include "base/error.hpp"
#include "host/gl_context.hpp"
#include "render/renderer.hpp"
#include "window/frame_pump.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tidemark::window {

class Stage : public FrameMaker {
public:
    /// Compiles the scene and makes the driver finish what it defers to the first draw. Meanwhile the context
    /// is current on the calling thread; afterwards on none.
    static Result<Stage> create(host::SharedContext context, scene::Scene scene,
                                const render::RenderOptions& options, const render::FrameInputs& first);
    /// Returns an optimised program of the same scene that draws the same bytes in frame 0 and in `shown` and
    /// takes clearly less time; fails if there is none, which callers may ignore.
    static Result<Stage> settle(host::SharedContext context, const scene::Scene& scene,
                                const render::RenderOptions& options, const render::FrameInputs& shown);
    Stage(Stage&&) = default;
    Stage& operator=(Stage&&) = delete;
    /// Keeps the calling thread's current context.
    ~Stage() override;

    /// Makes the context current on the window's thread, to draw into the window.
    Result<void> enter() { return context_.make_current_in_window(); }

    render::Renderer& renderer() { return *renderer_; }
    const render::Renderer& renderer() const { return *renderer_; }

    Extent extent() const override { return renderer_->extent(); }
    bool draw(const render::FrameInputs& inputs, std::vector<render::PassTimer>* timers) override;
    std::unique_ptr<FrameParts> begin(const render::FrameInputs& inputs, render::PartSize& size) override;
    void finish() override { glFinish(); }
    void reset() override { renderer_->reset(); }

    /// Returns the idle time, in seconds, before background optimisation is worth trying; none: it never is.
    std::optional<double> seconds_to_settle() const { return seconds_to_settle_; }
    /// Returns the frame time of an optimised program as a share of the original's.
    std::optional<double> share() const { return share_; }

private:
    Stage(host::SharedContext context, std::unique_ptr<render::Renderer> renderer)
        : context_(std::move(context)), renderer_(std::move(renderer)) {}

    host::SharedContext context_;
    std::unique_ptr<render::Renderer> renderer_;
    std::optional<double> seconds_to_settle_;
    std::optional<double> share_;
};

/// Returns whether threads may compile. Some drivers cannot compile and draw at once in shared contexts (see
/// Dolphin's pull request 7276); with TIDEMARK_ASYNC_COMPILE=off the window waits for the compiler instead.
bool compiles_on_threads();

// A helper process that first tries what may be too much for the driver. Each try runs in a further process,
// which may crash, use all of its allowed memory, or be cancelled.

/// Current values of --set and --define, `NAME=VALUE` each.
struct HeldTexts {
    std::vector<std::string> sets;
    std::vector<std::string> defines;
};

class Rehearsal {
public:
    using Play = std::function<void(const HeldTexts& held)>;
    /// Starts the helper. Call it before this process has an OpenGL context or threads. `play` is the work of
    /// each try, in a process that shares nothing with this one; `memory` in bytes, 0: no limit. Returns
    /// nullptr where no process can be started.
    static std::shared_ptr<Rehearsal> start(const Play& play, uint64_t memory);
    Rehearsal(const Rehearsal&) = delete;
    Rehearsal& operator=(const Rehearsal&) = delete;
    /// Kills the helper and the try in progress.
    ~Rehearsal();

    /// Runs one try and waits for it; fails (ErrorCode::load) if it crashed or used too much memory. Returns
    /// early, with any result, once `unwanted` returns true. May be called from any thread; calls run one at
    /// a time.
    Result<void> try_out(const HeldTexts& held, const std::function<bool()>& unwanted);

private:
    Rehearsal(int child, int socket) : child_(child), socket_(socket) {}

    int child_;
    int socket_;
    std::mutex one_;
};

// Builds Stages on worker threads, so that the window goes on while the driver compiles. Driver calls cannot
// be interrupted: an abandoned build ends by itself, and its result is discarded.

class StageBuilder {
public:
    /// The input of a build.
    struct Order {
        host::SharedContext context;
        scene::Scene scene;
        render::RenderOptions options;
        render::FrameInputs first;              ///< inputs of the first frame
        bool settle = false;                    ///< Stage::settle instead of Stage::create
        std::shared_ptr<Rehearsal> rehearsal{}; ///< tries heavy scenes first; null: no tries
        HeldTexts held{};                       ///< the overrides in the scene
    };

    /// `wake` is called on another thread when `take` has a result.
    explicit StageBuilder(std::function<void()> wake) : wake_(std::move(wake)) {}
    /// Waits for all builds: see `busy`.
    ~StageBuilder();
    StageBuilder(StageBuilder&&) = default;
    StageBuilder& operator=(StageBuilder&&) = delete;

    /// Abandons the current build and starts another. The order waits if several abandoned builds still
    /// occupy the driver.
    void start(Order order);
    void abandon();

    /// Returns the result of the last order, once.
    std::optional<Result<Stage>> take();

    /// Returns whether an order is in progress or waits.
    bool building() const { return newest_ != nullptr || waiting_.has_value(); }
    /// Returns whether a thread is in the driver, perhaps for long. To exit at once then, the process must be
    /// ended.
    bool busy() const;

private:
    struct Job; ///< shared by its thread and this object
    void launch(Order order);
    void sweep();

    std::function<void()> wake_;
    std::vector<std::pair<std::thread, std::shared_ptr<Job>>> running_; ///< including abandoned ones
    std::shared_ptr<Job> newest_;
    std::optional<Order> waiting_;
};

} // namespace tidemark::window
