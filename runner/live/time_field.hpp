// Where a scene is in time, as the time bar shows it.
#pragma once

#include <optional>

namespace tidemark::live {

/// On the way to a frame of a scene with feedback, which every frame before it leads to.
struct Stepping {
    int frame = 0;
    int last = 0;
};

struct TimeField {
    double seconds = 0;
    int frame = 0;
    bool paused = false;
    double speed = 1;
    bool turns_back = false; ///< frames do not depend on those before them: time may run backwards
    bool has_speed = true;   ///< the wall clock's: where frames are counted there is none
    std::optional<double> loop_from{};
    std::optional<double> loop_to{};
    std::optional<Stepping> stepping{};
};

/// Where the bar ends: it doubles as time comes near.
double bar_end(const TimeField& time);

} // namespace tidemark::live
