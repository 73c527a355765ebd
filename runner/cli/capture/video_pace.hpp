// How fast a video shows the frames that were asked for.
#pragma once

#include <string>
#include <vector>

namespace tidemark::cli {

struct VideoPace {
    double fps = 60;           ///< of the video
    std::string not_in_time{}; ///< why a second of it is not a second of the scene; empty: it is
};

/// Frames that are evenly apart, `0-118x2`, are shown so far apart as they are: a second takes a second.
/// Others come one after another, `fps` a second; backwards ones take as long as forwards.
VideoPace pace_of(const std::vector<int>& frames, double fps);

} // namespace tidemark::cli
