// `tidemark capture SCENE -o sound.wav`: what the Sound pass plays, as a file.
#pragma once

#include "cli/interrupt.hpp"
#include "cli/requests.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace tidemark::cli {

struct SoundRequest {
    std::string output;
    std::string device;
    double duration = 60; ///< seconds
};

/// The scene's sound from `start` on, left and right in turn, render::k_sample_rate a second each. An
/// interrupt cuts it short. A context must be current.
Result<std::vector<int16_t>> draw_sound(const scene::Scene& scene, glsl::Precision precision, double start,
                                        double duration, const Interrupt& interrupt);

Result<int> capture_sound(const SceneRequest& scene, const SoundRequest& request);

} // namespace tidemark::cli
