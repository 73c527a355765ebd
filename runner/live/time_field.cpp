#include "live/time_field.hpp"

#include <algorithm>

namespace tidemark::live {

double bar_end(const TimeField& time) {
    const double needed = std::max(time.seconds, time.loop_to.value_or(0));
    double end = 10;
    while (end < needed)
        end *= 2;
    return end;
}

} // namespace tidemark::live
