#include "cli/view/pass_costs.hpp"

namespace tidemark::cli {

std::vector<render::PassTimer>* PassCosts::next_frame() {
    frame_before_.reset();
    for (const render::PassTimer& timer : timers_)
        if (const auto took = timer.time.milliseconds(); took) {
            milliseconds_[timer.pass] = *took;
            frame_before_ = frame_before_.value_or(0) + *took;
        }
    timers_.clear();
    return &timers_;
}

void PassCosts::forget() {
    timers_.clear();
    milliseconds_.clear();
    frame_before_.reset();
}

std::optional<double> PassCosts::of(size_t pass) const {
    const auto known = milliseconds_.find(pass);
    return known == milliseconds_.end() ? std::nullopt : std::optional(known->second);
}

} // namespace tidemark::cli
