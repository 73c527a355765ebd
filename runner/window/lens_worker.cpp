#include "window/lens_worker.hpp"

#include "base/error.hpp"
#include "render/frame_in_parts.hpp"
#include "render/renderer.hpp"
#include "window/screen.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <map>
#include <utility>

namespace tidemark::window {
namespace {

using Mark = lab::LensNumbers::Mark;

/// Drawing time of the thread between two looks for a cancellation.
constexpr double k_turn_seconds = 0.03;
/// Pause after that, in which the window's own drawing gets the driver.
constexpr auto k_breath = std::chrono::milliseconds(2);
/// Time of the first, coarse proof; each further one takes up to four times as long.
constexpr double k_first_proof_seconds = 0.25;
/// Lower priority of the thread, so that proofs on all cores do not slow the window down.
constexpr int k_niceness = 10;
/// Frame whose lines are counted in a scene with feedback, where all earlier frames must be drawn.
constexpr int k_early_frame = 30;
constexpr size_t k_hot_lines = 10;

/// Draws orders. Its objects live in the context of the thread.
class LensDrawer {
public:
    using Answer = std::function<void(LensPicture)>;

    explicit LensDrawer(lab::KeepGoing keep_going) : keep_going_(std::move(keep_going)) {}

    /// Fails with any error once it was cancelled.
    Result<LensPicture> draw_numbers(const LensOrder& order, const Answer& coarse);
    Result<FrameFacts> draw_facts(const LensOrder& order);
    Result<lab::HotLines> count_lines(const LensOrder& order);

private:
    /// A Renderer and the times of its parts.
    struct Drawn {
        explicit Drawn(render::Renderer made) : renderer(std::move(made)) {}
        render::Renderer renderer;
        render::PartSize parts{};
    };
    struct Instrument {
        lab::LensPlan plan;             ///< without its scene
        std::unique_ptr<Drawn> drawn{}; ///< null: the lens needs no other text
    };

    void adopt(const LensMoment& moment);
    Result<Drawn*> plain();
    Result<Instrument*> instrument(const lab::Lens& lens);
    Result<Instrument> make_instrument(const lab::Lens& lens) const;
    Result<double> draw(Drawn& drawn, const LensMoment& moment, Extent extent) const;
    Result<lab::LensNumbers> read(const lab::Lens& lens, const LensMoment& moment);

    lab::KeepGoing keep_going_;
    std::shared_ptr<const scene::Scene> scene_;
    std::unique_ptr<Drawn> plain_;
    std::map<std::string, Result<Instrument>> instruments_; ///< by the lens's text
};

void LensDrawer::adopt(const LensMoment& moment) {
    if (std::exchange(scene_, moment.scene) == moment.scene)
        return;
    plain_.reset();
    instruments_.clear();
}

Result<LensDrawer::Drawn*> LensDrawer::plain() {
    if (!plain_)
        plain_ = std::make_unique<Drawn>(
            TRY(render::Renderer::create(*scene_, {.extent = {16, 16},
                                                   .samples = image::SampleType::f32,
                                                   .specialise = glsl::Specialise::unreachable})));
    return plain_.get();
}

Result<LensDrawer::Instrument> LensDrawer::make_instrument(const lab::Lens& lens) const {
    Instrument made{TRY(lab::make_lens(
        *scene_, lens, lens.name == lab::LensName::cost ? lab::device_weights() : glsl::WorkWeights{}))};
    if (!made.plan.drawn)
        return made;
    made.drawn = std::make_unique<Drawn>(
        TRY(render::Renderer::create(*std::move(made.plan.drawn), lab::lens_options(made.plan, {16, 16}))));
    made.plan.drawn.reset();
    return made;
}

Result<LensDrawer::Instrument*> LensDrawer::instrument(const lab::Lens& lens) {
    const std::string name = lab::to_string(lens);
    auto known = instruments_.find(name);
    if (known == instruments_.end())
        known = instruments_.emplace(name, make_instrument(lens)).first;
    if (!known->second)
        return fail(known->second.error());
    return &*known->second;
}

/// Draws a frame in parts. Returns the seconds that it took.
Result<double> LensDrawer::draw(Drawn& drawn, const LensMoment& moment, Extent extent) const {
    if (drawn.renderer.extent() != extent)
        TRY(drawn.renderer.resize(extent));
    if (moment.buffers && !drawn.renderer.restore(*moment.buffers))
        return fail(ErrorCode::load, "its buffers cannot take those of the window");
    render::FrameInParts frame(drawn.renderer, moment.inputs, drawn.parts, now_seconds);
    while (!TRY(frame.draw_for(k_turn_seconds))) {
        if (!keep_going_())
            return fail(ErrorCode::load, "cancelled");
        std::this_thread::sleep_for(k_breath);
    }
    double seconds = 0;
    for (const auto& pass : frame.seconds())
        seconds += pass.seconds;
    return seconds;
}

LensPicture picture_of(const lab::LensPlan& plan, lab::LensNumbers numbers) {
    LensPicture picture{plan, std::move(numbers), {}, {}, {}};
    picture.summary = lab::summary_of(plan, picture.numbers);
    picture.range = lab::range_of(plan, picture.summary);
    picture.map = lab::lens_map(plan, picture.numbers);
    return picture;
}

/// Returns the numbers of an unfinished proof with each unknown pixel as that of the coarser grid.
lab::LensNumbers in_blocks(lab::LensNumbers numbers) {
    const Extent extent = numbers.extent;
    const std::vector<Mark> known = numbers.marks;
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x)
            for (int side = 2; side <= lab::k_coarsest_stride; side *= 2) {
                const auto place = [&](int column, int row) {
                    return size_t(row) * size_t(extent.width) + size_t(column);
                };
                const size_t at = place(x, y), from = place(x - x % side, y - y % side);
                if (known[at] != Mark::absent)
                    break;
                if (known[from] == Mark::absent)
                    continue;
                numbers.marks[at] = known[from];
                numbers.values[at] = numbers.values[from];
                break;
            }
    return numbers;
}

Result<LensPicture> LensDrawer::draw_numbers(const LensOrder& order, const Answer& coarse) {
    const LensMoment& moment = order.moment;
    adopt(moment);
    Instrument& it = *TRY(instrument(order.lens));
    Drawn& own = *TRY(plain());
    const bool whole = order.lens.name == lab::LensName::rounding; // it cannot be drawn in parts
    TRY(draw(own, moment, whole ? moment.quick : moment.state.extent));
    if (it.drawn)
        TRY(draw(*it.drawn, moment, moment.state.extent));
    const lab::LensFrame frame{own.renderer, it.drawn ? &it.drawn->renderer : nullptr, moment.inputs};
    if (order.lens.name != lab::LensName::proof)
        return picture_of(it.plan, TRY(lab::read_lens(it.plan, frame, keep_going_)));
    for (double seconds = k_first_proof_seconds;; seconds *= 4) {
        const double until = now_seconds() + seconds;
        auto numbers =
            TRY(lab::read_lens(it.plan, frame, [&] { return now_seconds() < until && keep_going_(); }));
        if (numbers.complete || !keep_going_())
            return picture_of(it.plan, std::move(numbers));
        LensPicture picture = picture_of(it.plan, std::move(numbers));
        picture.map = lab::lens_map(it.plan, in_blocks(picture.numbers));
        coarse(std::move(picture));
    }
}

/// Draws the lens of a frame whose plain picture is drawn.
Result<lab::LensNumbers> LensDrawer::read(const lab::Lens& lens, const LensMoment& moment) {
    Instrument& it = *TRY(instrument(lens));
    TRY(draw(*it.drawn, moment, moment.state.extent));
    return lab::read_lens(it.plan, {plain_->renderer, &it.drawn->renderer, moment.inputs}, keep_going_);
}

Result<FrameFacts> LensDrawer::draw_facts(const LensOrder& order) {
    const LensMoment& moment = order.moment;
    adopt(moment);
    Drawn& own = *TRY(plain());
    FrameFacts facts;
    facts.milliseconds = 1000 * TRY(draw(own, moment, moment.state.extent));
    const image::Image colours = own.renderer.read_floats(own.renderer.shown_index());
    for (size_t i = 0; i < colours.f32().size(); i += 4)
        facts.nan += std::any_of(&colours.f32()[i], &colours.f32()[i] + 3,
                                 [](float sample) { return std::isnan(sample); });
    const lab::Lens error{.name = lab::LensName::error};
    if (const auto numbers = read(error, moment); !numbers) {
        facts.no_error = lab::reason_of(numbers.error());
    } else {
        double sum = 0, finite = 0;
        for (size_t i = 0; i < numbers->values.size(); ++i)
            if (const auto value = double(numbers->values[i]); std::isfinite(value)) {
                sum += value * value;
                ++finite;
                if (value > facts.worst || finite == 1) {
                    facts.worst = value;
                    const auto width = size_t(numbers->extent.width);
                    facts.worst_at = {int(i % width), int(i / width)};
                }
            }
        facts.error = finite > 0 ? std::sqrt(sum / finite) : std::nan("");
    }
    if (!keep_going_())
        return facts;
    if (const auto steps = read({.name = lab::LensName::steps}, moment))
        facts.run_out = size_t(std::ranges::count(steps->marks, Mark::marked));
    return facts;
}

Result<lab::HotLines> LensDrawer::count_lines(const LensOrder& order) {
    adopt(order.moment);
    return lab::hot_lines(*scene_, counted_state(order.moment), k_hot_lines, lab::device_weights());
}

} // namespace

render::FrameState counted_state(const LensMoment& moment) {
    render::FrameState state = moment.has_feedback ? moment.state.at_frame(k_early_frame) : moment.state;
    state.extent = moment.quick;
    return state;
}

LensWorker::LensWorker(host::SharedContext context, std::function<void()> wake)
    : wake_(std::move(wake)),
      thread_([this, own = std::make_shared<host::SharedContext>(std::move(context))]() mutable {
          run(std::move(*own));
      }) {}

LensWorker::~LensWorker() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = cancelled_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void LensWorker::start(LensOrder order) {
    {
        const std::lock_guard lock(mutex_);
        order_.emplace(std::move(order));
        cancelled_ = false;
    }
    changed_.notify_all();
}

void LensWorker::cancel() {
    const std::lock_guard lock(mutex_);
    cancelled_ = true;
    answers_.clear();
}

void LensWorker::stop() {
    constexpr auto k_patience = std::chrono::milliseconds(300);
    cancel();
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, k_patience, [&] { return !order_; });
}

bool LensWorker::busy() const {
    const std::lock_guard lock(mutex_);
    return order_.has_value();
}

std::optional<LensAnswer> LensWorker::take() {
    const std::lock_guard lock(mutex_);
    if (answers_.empty())
        return std::nullopt;
    LensAnswer first = std::move(answers_.front());
    answers_.pop_front();
    return first;
}

bool LensWorker::keeps_going() const {
    const std::lock_guard lock(mutex_);
    return !cancelled_;
}

void LensWorker::answer(LensAnswer answer) {
    {
        const std::lock_guard lock(mutex_);
        if (cancelled_)
            return;
        answers_.push_back(std::move(answer));
    }
    wake_();
}

void LensWorker::run(host::SharedContext context) {
    ::setpriority(PRIO_PROCESS, 0, k_niceness); // of this thread alone, and of those that it starts
    const auto entered = context.make_current();
    {
        LensDrawer drawer([this] { return keeps_going(); });
        while (true) {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return ended_ || order_; });
            if (ended_)
                break;
            const LensOrder order = *order_;
            lock.unlock();
            const auto put = [&](auto result) {
                if (result)
                    answer({order, *std::move(result)});
                else
                    answer({order, std::move(result.error())});
            };
            try {
                if (!entered)
                    answer({order, entered.error()});
                else if (order.kind == LensOrder::Kind::numbers)
                    put(drawer.draw_numbers(order, [&](LensPicture coarse) {
                        answer({order, std::move(coarse)});
                    }));
                else if (order.kind == LensOrder::Kind::facts)
                    put(drawer.draw_facts(order));
                else
                    put(drawer.count_lines(order));
            } catch (const std::exception& error) {
                answer({order, Error{ErrorCode::load, error.what()}});
            }
            lock.lock();
            order_.reset();
            lock.unlock();
            changed_.notify_all();
            wake_();
        }
    } // its objects are deleted in the context
    context.leave();
}

} // namespace tidemark::window
