// How fast a video shows the frames that were asked for, and how long each of them.
#pragma once

#include <string>
#include <vector>

namespace tidemark::cli {

struct VideoPace {
    double fps = 60;           ///< of the video: its ticks
    int tick = 1;              ///< frames of the scene; 0: one after another
    bool holds = false;        ///< some frame is shown until a later one is due
    std::string not_in_time{}; ///< why a second of it is not a second of the scene; empty: it is
};

/// Frames that are ever later are shown when they are due, each until the next one: a second takes a second.
/// Of those evenly apart, `0-118x2`, each is one tick of the video. Others come one after another, `fps` a
/// second; backwards ones take as long as forwards.
VideoPace pace_of(const std::vector<int>& frames, double fps);

/// How long each of them is shown. The last one, behind which nothing is due, one tick.
std::vector<int> ticks_of(const std::vector<int>& frames, const VideoPace& pace);

} // namespace tidemark::cli
