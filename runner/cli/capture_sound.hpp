// `tidemark capture SCENE -o sound.wav`: what the Sound pass plays, as a file.
#pragma once

#include "cli/requests.hpp"

#include <string>

namespace tidemark::cli {

struct SoundRequest {
    std::string output;
    std::string device;
    double duration = 60; ///< seconds
};

Result<int> capture_sound(const SceneRequest& scene, const SoundRequest& request);

} // namespace tidemark::cli
