// Builds Stages on threads of their own, so that a window goes on while the driver compiles. A driver cannot
// be interrupted: what is not wanted any more is abandoned, and ends by itself.
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
    /// What a Stage is made of.
    struct Order {
        platform::SharedContext context;
        scene::Scene scene;
        render::RenderOptions options;
        render::FrameInputs first;              ///< inputs of its first frame
        bool settle = false;                    ///< Stage::settle instead of Stage::create
        std::shared_ptr<Rehearsal> rehearsal{}; ///< of what is no modest scene; none: nothing is tried out
        HeldTexts held{};                       ///< that are in the scene
    };

    /// `wake` is called on another thread when there is something to `take`.
    explicit StageBuilder(std::function<void()> wake) : wake_(std::move(wake)) {}
    /// Waits for everything under way: see `busy`.
    ~StageBuilder();
    StageBuilder(StageBuilder&&) = default;
    StageBuilder& operator=(StageBuilder&&) = delete;

    /// Abandons what is under way. Where several abandoned ones still keep the driver busy, the order waits.
    void start(Order order);
    void abandon();

    /// What the last order gave, once.
    std::optional<Result<Stage>> take();

    /// An order is under way or waits.
    bool building() const { return newest_ != nullptr || waiting_.has_value(); }
    /// A thread is in the driver, perhaps for long; whoever wants to end now must end the process.
    bool busy() const;

private:
    struct Job; ///< shared by its thread and by us, whoever lives longer
    void launch(Order order);
    void sweep();

    std::function<void()> wake_;
    std::vector<std::pair<std::thread, std::shared_ptr<Job>>> running_; ///< abandoned ones included
    std::shared_ptr<Job> newest_;
    std::optional<Order> waiting_;
};

} // namespace tidemark::cli
