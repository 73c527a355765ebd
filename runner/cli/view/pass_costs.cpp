#include "cli/view/pass_costs.hpp"

#include <utility>

namespace tidemark::cli {

std::vector<render::PassTimer>* PassCosts::next_frame() {
    frame_before_ = std::exchange(in_parts_, std::nullopt);
    for (const render::PassTimer& timer : timers_)
        if (const auto took = timer.time.milliseconds(); took) {
            milliseconds_[timer.pass] = *took;
            frame_before_ = frame_before_.value_or(0) + *took;
        }
    timers_.clear();
    return &timers_;
}

void PassCosts::took(size_t pass, double milliseconds) {
    milliseconds_[pass] = milliseconds;
    in_parts_ = in_parts_.value_or(0) + milliseconds;
}

void PassCosts::forget() {
    in_parts_.reset();
    timers_.clear();
    milliseconds_.clear();
    frame_before_.reset();
}

std::optional<double> PassCosts::of(size_t pass) const {
    const auto known = milliseconds_.find(pass);
    return known == milliseconds_.end() ? std::nullopt : std::optional(known->second);
}

} // namespace tidemark::cli
