// The frame rate of a video, and how long each frame is shown.
#pragma once

#include <string>
#include <vector>

namespace tidemark::cli {

struct VideoPace {
    double fps = 60;           ///< ticks a second of the video
    int tick = 1;  ///< frames of the scene per tick; 0: one frame after another, regardless of time
    bool holds = false;        ///< some frame is shown for several ticks
    std::string not_in_time{}; ///< why the video does not run in the scene's time; empty: it does
};

/// Chooses the frame rate. Ascending frames are shown at their time, each until the next one; evenly spaced
/// ones, for example `0-118x2`, take one tick each. Other sequences are shown one after another, `fps` a
/// second; evenly descending ones take as long as ascending ones.
VideoPace pace_of(const std::vector<int>& frames, double fps);

/// Returns how many ticks each frame is shown. The last one takes one tick.
std::vector<int> ticks_of(const std::vector<int>& frames, const VideoPace& pace);

} // namespace tidemark::cli
