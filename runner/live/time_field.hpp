// The time of a scene, as the time bar shows it.
#pragma once

#include <optional>

namespace tidemark::live {

/// Progress towards a frame of a scene with feedback, for which all earlier frames must be drawn.
struct Stepping {
    int frame = 0;
    int last = 0;
};

struct TimeField {
    double seconds = 0;
    int frame = 0;
    bool paused = false;
    double speed = 1;
    bool turns_back = false; ///< no feedback: time may run backwards
    bool has_speed = true;   ///< false while recording or replaying, where frames are counted instead of time
    std::optional<double> loop_from{};
    std::optional<double> loop_to{};
    std::optional<Stepping> stepping{};
};

/// Returns the end of the bar, in seconds: 10, doubled until the time and the loop's end fit.
double bar_end(const TimeField& time);

} // namespace tidemark::live
