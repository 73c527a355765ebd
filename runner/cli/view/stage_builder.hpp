// Builds Stages on worker threads, so that the window goes on while the driver compiles. Driver calls cannot
// be interrupted: an abandoned build ends by itself, and its result is discarded.
#pragma once

#include "cli/view/rehearsal.hpp"
#include "cli/view/stage.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

namespace tidemark::cli {

class StageBuilder {
public:
    /// The input of a build.
    struct Order {
        platform::SharedContext context;
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

} // namespace tidemark::cli
