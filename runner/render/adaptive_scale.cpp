#include "render/adaptive_scale.hpp"

#include <algorithm>
#include <vector>

namespace tidemark::render {
namespace {

/// The median of five frames ignores two slow ones.
constexpr size_t k_frames_down = 5;
constexpr size_t k_frames_up = 30;
/// Fractions of the budget. Between the two the scale stays: frames that take the whole budget occasionally
/// measure up to a tenth more or a fifth less.
constexpr double k_too_slow = 1.1;
constexpr double k_fast_enough = 0.8;

double median_of_last(const std::deque<double>& values, size_t count) {
    std::vector<double> last(values.end() - std::ptrdiff_t(count), values.end());
    const auto middle = last.begin() + std::ptrdiff_t(count / 2);
    std::ranges::nth_element(last, middle);
    return *middle;
}

} // namespace

RenderScale AdaptiveScale::after_frame(RenderScale scale, double milliseconds) {
    recent_.push_back(milliseconds);
    if (recent_.size() > k_frames_up)
        recent_.pop_front();
    auto wanted = lower(scale);
    if (wanted && before_step_up_) // a step that is undone shows its cost
        growth_ = std::max(growth_, median_of_last(recent_, k_frames_down) / *before_step_up_);
    if (wanted || recent_.size() == k_frames_up)
        before_step_up_.reset();
    if (!wanted)
        wanted = higher(scale);
    if (!wanted)
        return scale;
    recent_.clear();
    return *wanted;
}

void AdaptiveScale::forget() {
    recent_.clear();
    before_step_up_.reset();
    growth_ = k_pixels;
}

/// Returns the next scale whose frames may be quick enough. The time falls at most in proportion to the
/// pixels, so the scale is not lower than necessary.
std::optional<RenderScale> AdaptiveScale::lower(RenderScale scale) const {
    if (recent_.size() < k_frames_down)
        return std::nullopt;
    double expected = median_of_last(recent_, k_frames_down);
    if (expected <= k_too_slow * budget_)
        return std::nullopt;
    RenderScale wanted = scale;
    while (expected > budget_ && wanted.stepped(-1) != wanted) {
        wanted = wanted.stepped(-1);
        expected /= k_pixels;
    }
    return wanted == scale ? std::nullopt : std::optional(wanted);
}

std::optional<RenderScale> AdaptiveScale::higher(RenderScale scale) {
    if (recent_.size() < k_frames_up || scale.stepped(1) == scale)
        return std::nullopt;
    const double now = median_of_last(recent_, k_frames_up);
    if (now * growth_ > k_fast_enough * budget_)
        return std::nullopt;
    before_step_up_ = now;
    return scale.stepped(1);
}

} // namespace tidemark::render
