#include "cli/capture/stepper.hpp"

namespace tidemark::cli {

bool Stepper::draw(int frame, const std::function<bool(int frame, int last)>& before_step) {
    if (!renderer_.plan().feedback) {
        next_ = frame;
    } else if (frame < next_) {
        renderer_.reset();
        next_ = 0;
    }
    for (; next_ <= frame; ++next_) {
        if (!before_step(next_, frame))
            return false;
        renderer_.draw(inputs_of_(next_));
    }
    return true;
}

} // namespace tidemark::cli
