#include "window/frame_pump.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace tidemark::window {
namespace {

using Way = FramePace::Way;

/// Too short a delay to be noticed. A frame that waits for the screen at 24 Hz takes less.
constexpr double k_whole_seconds = 0.05;
/// Between the two limits the way stays the same.
constexpr double k_whole_again_seconds = 0.03;

/// Drawing time in one round of the event loop: two of these and a part take less than 0.1 s.
constexpr double k_round_seconds = 0.03;
/// A frame or a part that takes longer counts as long: Esc cancels the frame.
constexpr double k_long_seconds = 1;
/// Shortest pause between two frames that block the window, for events and file changes.
constexpr double k_breath_seconds = 0.05;
/// Interval at which the progress over the picture is updated.
constexpr double k_progress_seconds = 0.25;
/// Progress is not shown before this time.
constexpr double k_short_seconds = 0.3;
/// After longer frames, progress is shown from the beginning until a frame takes less than this.
constexpr double k_quick_seconds = 0.15;

} // namespace

std::optional<double> FramePace::expected(Extent extent) const {
    return seconds_of_pixel_ ? std::optional(*seconds_of_pixel_ * double(extent.pixels())) : std::nullopt;
}

FramePace::Way FramePace::way(Extent extent) const {
    const double longest = last_ == Way::whole ? k_whole_seconds : k_whole_again_seconds;
    return expected(extent).value_or(longest) < longest ? Way::whole : Way::in_parts;
}

void FramePace::took(Extent extent, Way way, double seconds) {
    if (extent.pixels() == 0)
        return;
    seconds_of_pixel_ = seconds / double(extent.pixels());
    last_ = way;
}

bool FramePump::begin_round(Extent drawn) {
    const double now = clock_();
    held_seconds_ = now - listened_at_;
    blocked_ = held_seconds_ > k_long_seconds;
    if (std::exchange(drew_, false)) {
        slow_ = blocked_;
        pace_.took(drawn, Way::whole, held_seconds_);
    }
    if (ending_ && ending_->wait(0))
        ending_.reset();
    if (blocked_)
        next_draw_ = std::max(next_draw_, now + k_breath_seconds);
    return blocked_;
}

bool FramePump::wants_frame(const Around& around, double now) const {
    if (!around.watched)
        return false;
    if (goes_on(around, now))
        return true;
    if (seek_ || driver_busy())
        return false;
    if (shows_panels(around))
        return true;
    if (making_ || waits_for_reload(around, now) || (slow_ && now < next_draw_))
        return false;
    return wanted_ || (moving(around) && now >= next_draw_);
}

double FramePump::due(const Around& around, double now) const {
    if ((around.watched && goes_on(around, now)) || seek_ || around.events_held)
        return now;
    if (!around.watched || driver_held(now))
        return std::numeric_limits<double>::infinity();
    if ((wanted_ && !slow_ && !making_) || shows_panels(around))
        return now;
    if ((wanted_ || moving(around)) && !making_ && !waits_for_reload(around, now))
        return next_draw_;
    return std::numeric_limits<double>::infinity();
}

std::optional<bool> FramePump::take_due(const Around& around, double now) {
    if (making_)
        return std::nullopt;
    const bool wanted = std::exchange(wanted_, false);
    if (flow_ == Flow::cancelled || !(wanted || (moving(around) && now >= next_draw_)))
        return std::nullopt;
    next_draw_ = std::max(next_draw_ + 1 / fps_, now);
    return wanted;
}

std::optional<FramePump::Made> FramePump::begin(FrameMaker& maker, const render::FrameState& state,
                                                const render::FrameInputs& inputs, bool wanted, double now,
                                                std::vector<render::PassTimer>* timers) {
    Made frame{.state = state, .begun = now, .wanted = wanted};
    if (!parts_fail_ && pace_.way(state.extent) == Way::in_parts) {
        making_.emplace(Making{std::move(frame), maker.begin(inputs, part_size_), maker.extent()});
        return std::nullopt;
    }
    frame.drawn = drew_ = maker.draw(inputs, timers);
    remember_duration(0);
    return frame;
}

/// Decides between rate and progress in the title; between the two limits the choice stays.
void FramePump::remember_duration(double seconds) {
    shows_progress_ = seconds > (shows_progress_ ? k_quick_seconds : k_short_seconds);
}

Result<std::optional<FramePump::Made>> FramePump::advance() {
    const auto whole = making_->parts->draw_for(k_round_seconds);
    if (!whole) {
        parts_fail_ = wanted_ = true;
        return tl::unexpected(whole.error());
    }
    if (!*whole)
        return std::nullopt;
    Making made = *std::exchange(making_, std::nullopt);
    made.frame.drawn = made.parts->drew_pass();
    made.frame.seconds = made.parts->seconds();
    if (made.frame.drawn) { // else nothing is known about the next one's time
        double seconds = 0;
        for (const auto& pass : made.frame.seconds)
            seconds += pass.seconds;
        pace_.took(made.frame.state.extent, Way::in_parts, seconds);
        slow_ = clock_() - made.frame.begun > k_long_seconds;
        remember_duration(clock_() - made.frame.begun);
    }
    return std::move(made.frame);
}

bool FramePump::cancel() {
    FrameParts* const parts = seek_ ? seek_->parts.get() : making_ ? making_->parts.get() : nullptr;
    if (auto work = parts ? parts->cancel() : std::nullopt)
        ending_ = std::move(work);
    seek_.reset();
    return std::exchange(making_, std::nullopt).has_value();
}

void FramePump::stop(double now) {
    flow_ = Flow::cancelled;
    stopped_at_ = now;
}

bool FramePump::resume() {
    const bool stopped = flow_ == Flow::cancelled;
    if (stopped)
        flow_ = Flow::running;
    return stopped;
}

void FramePump::forget_scene() {
    ending_.reset();
    parts_fail_ = false;
    pace_.doubt();
    part_size_ = {};
}

void FramePump::begin_scene() {
    resume();
    slow_ = shows_progress_ = false;
    wanted_ = true;
}

void FramePump::doubt(Extent drawn) {
    constexpr size_t k_first_parts = 16;
    pace_.doubt();
    part_size_.doubt(drawn.pixels() / k_first_parts);
}

void FramePump::seek(FrameMaker& maker, render::FrameStates states, int last, double seconds) {
    seek_.emplace(Seek{&maker, std::move(states), seconds, {0, last}});
}

std::optional<double> FramePump::advance_seek(double seconds) {
    const double until = clock_() + seconds;
    if (seek_->next == 0 && !seek_->parts)
        seek_->maker->reset();
    for (bool first = true; seek_->next <= seek_->where.last; first = false) {
        if (!first && clock_() >= until)
            return std::nullopt;
        seek_->where.frame = seek_->next;
        if (!draw_seek_frame(inputs_of(seek_->states(seek_->next)), until))
            return std::nullopt;
        ++seek_->next;
    }
    return std::exchange(seek_, std::nullopt)->seconds;
}

/// Returns whether the frame is complete.
bool FramePump::draw_seek_frame(const render::FrameInputs& inputs, double until) {
    FrameMaker& maker = *seek_->maker;
    if (!seek_->parts && pace_.way(maker.extent()) == Way::whole) {
        draw_whole(maker, inputs);
        return true;
    }
    if (!seek_->parts)
        seek_->parts = maker.begin(inputs, part_size_);
    const auto whole = seek_->parts->draw_for(std::max(0.0, until - clock_()));
    if (whole && !*whole)
        return false;
    double took = 0;
    for (const auto& pass : seek_->parts->seconds())
        took += pass.seconds;
    seek_->parts.reset();
    if (whole)
        pace_.took(maker.extent(), Way::in_parts, took);
    else // not enough memory for parts
        draw_whole(maker, inputs);
    return true;
}

void FramePump::draw_whole(FrameMaker& maker, const render::FrameInputs& inputs) {
    const double begun = clock_();
    maker.draw(inputs, nullptr);
    maker.finish(); // else some drivers queue much more work than there is time for
    pace_.took(maker.extent(), Way::whole, clock_() - begun);
}

bool FramePump::moving(const Around& around) const {
    return around.plays && flow_ == Flow::running && !seek_;
}

bool FramePump::goes_on(const Around& around, double now) const {
    return making_ && !waits_for_reload(around, now);
}

bool FramePump::shows_panels(const Around& around) const {
    return around.watched && around.panels_changed && (making_ || !moving(around));
}

/// Returns whether to wait for a reload: do not continue a slow frame while one is compiling.
bool FramePump::waits_for_reload(const Around& around, double now) const {
    return around.compiles && (slow_ || draws_for_long(now));
}

/// The time of the last frame alone does not show it: that frame may have waited for other work, and without
/// motion the time is never updated.
bool FramePump::would_block(Extent drawn) const {
    return slow_ && pace_.expected(drawn).value_or(k_long_seconds) >= k_long_seconds;
}

bool FramePump::draws_for_long(double now) const {
    return making_ && now - making_->frame.begun > k_long_seconds;
}

bool FramePump::can_stop(const Around& around, double now) const {
    return blocked_ || draws_for_long(now) || (slow_ && (moving(around) || making_));
}

bool FramePump::just_stopped(double now) const {
    return flow_ == Flow::cancelled && now - stopped_at_ < k_long_seconds;
}

/// Returns the part that the driver is drawing: of this frame, of one that a seek draws, or of a cancelled
/// one.
std::optional<DriverWork> FramePump::work() const {
    if (seek_ && seek_->parts)
        return seek_->parts->work();
    return making_ ? making_->parts->work() : ending_;
}

bool FramePump::driver_busy() const {
    const auto at = work();
    return at && !at->wait(k_round_seconds);
}

bool FramePump::driver_held(double now) const {
    const auto at = work();
    return at && now - at->begun > k_long_seconds && !at->wait(0);
}

std::string FramePump::progress(double now, bool has_frame) const {
    if (!making_)
        return driver_held(now) && !(seek_ && seek_->parts)
                   ? fmt::format("cancelled, waiting for the driver: {:.0f} s", now - work()->begun)
                   : "";
    const double seconds = now - making_->frame.begun;
    if (seconds < k_short_seconds && has_frame && !shows_progress_)
        return "";
    return fmt::format("drawing {:.1f} s, {:.0f} %{}", seconds, 100 * making_->parts->share(),
                       seconds > k_long_seconds ? ", Esc cancels" : "");
}

bool FramePump::progress_due(double now) const {
    return draws_for_long(now) && now - progress_shown_at_ > k_progress_seconds;
}

std::string FramePump::share_text(double now) const {
    return making_ ? fmt::format("after {:.1f} s, {:.0f} % drawn", now - making_->frame.begun,
                                 100 * making_->parts->share())
                   : fmt::format("a frame takes {:.1f} s", held_seconds_);
}

std::optional<render::Part> FramePump::take_slow_part(double now) {
    const auto at = making_ && !making_->reported ? making_->parts->work() : std::nullopt;
    if (!at || now - at->begun < k_too_long_seconds)
        return std::nullopt;
    making_->reported = true;
    return at->part;
}

} // namespace tidemark::window
