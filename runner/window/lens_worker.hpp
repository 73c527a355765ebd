// Draws frames of the scene on show again, for their numbers: lenses, errors, lines. A thread does it in
// parts, in a context of its own, while the window goes on.
#pragma once

#include "base/error.hpp"
#include "host/gl_context.hpp"
#include "lab/lens.hpp"
#include "media/image.hpp"
#include "render/frame_state.hpp"
#include "render/pass_state.hpp"
#include "scene/scene.hpp"

#include <array>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

namespace tidemark::window {

/// A frame of the scene on show, to be drawn again.
struct LensMoment {
    std::shared_ptr<const scene::Scene> scene;
    render::FrameState state;
    render::FrameInputs inputs;
    /// The buffers that the frame read; none: the scene reads no earlier frame, or they are not known.
    std::optional<render::BufferState> buffers{};
    bool has_feedback = false;
    Extent quick{}; ///< a size in which a frame takes no longer than a part
};

/// Returns the state in which the lines of that moment are counted.
render::FrameState counted_state(const LensMoment& moment);

struct LensOrder {
    enum class Kind { numbers, facts, hot_lines } kind = Kind::numbers;
    lab::Lens lens{}; ///< of `numbers`
    LensMoment moment;
};

/// The numbers of a lens, and their picture.
struct LensPicture {
    lab::LensPlan plan; ///< without its scene
    lab::LensNumbers numbers;
    lab::LensSummary summary;
    lab::LensRange range;
    image::Image map; ///< RGBA bytes
};

/// Numbers of a frame for the status line and for a front.
struct FrameFacts {
    double milliseconds = 0;         ///< to draw it in float
    std::optional<double> error{};   ///< RMSE against double, in steps of 1/255; none: `no_error`
    double worst = 0;                ///< error of the worst pixel
    std::array<int, 2> worst_at{};   ///< that pixel, from the bottom left
    std::string no_error{};          ///< why there is no error
    std::optional<size_t> run_out{}; ///< rays that run out of iterations; none: no march was found
    size_t nan = 0;                  ///< pixels with a NaN
};

struct LensAnswer {
    LensOrder order;
    std::variant<Error, LensPicture, FrameFacts, lab::HotLines> result;
};

/// A thread with a context that carries out one order at a time.
class LensWorker {
public:
    /// `wake` is called on another thread when `take` has a result.
    LensWorker(host::SharedContext context, std::function<void()> wake);
    /// Waits for the driver: see `busy`.
    ~LensWorker();
    LensWorker(const LensWorker&) = delete;
    LensWorker& operator=(const LensWorker&) = delete;

    /// Starts an order. Call it only while no other is in progress.
    void start(LensOrder order);
    /// Abandons the order in progress; it has no further answers.
    void cancel();
    /// Abandons it, and waits a moment until the driver is free.
    void stop();
    /// Returns whether an order is in progress. To exit at once then, the process must be ended.
    bool busy() const;
    /// Returns the next answer. An order has several if a proof is refined.
    std::optional<LensAnswer> take();

private:
    void run(host::SharedContext context);
    bool keeps_going() const;
    void answer(LensAnswer answer);

    std::function<void()> wake_;
    mutable std::mutex mutex_; ///< guards the members below
    std::condition_variable changed_;
    std::optional<LensOrder> order_; ///< until it is done
    bool cancelled_ = false;
    bool ended_ = false;
    std::deque<LensAnswer> answers_;
    std::thread thread_;
};

} // namespace tidemark::window
