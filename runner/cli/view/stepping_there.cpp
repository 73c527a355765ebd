#include "cli/view/stepping_there.hpp"

#include "cli/view/wall_clock.hpp"

namespace tidemark::cli {

bool SteppingThere::advance(double seconds) {
    const double end = now_seconds() + seconds;
    bool first = true;
    const auto may_draw = [&](int frame, int) {
        glFinish(); // else a driver takes orders for much longer
        if (!std::exchange(first, false) && now_seconds() >= end)
            return false;
        where_.frame = frame;
        return true;
    };
    return stepper_.draw(where_.last, may_draw).complete;
}

} // namespace tidemark::cli
