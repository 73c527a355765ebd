// `tidemark capture SCENE -o sound.wav`: what the Sound pass plays, as a file.
#pragma once

#include "cli/capture/capture_plan.hpp"
#include "cli/interrupt.hpp"

#include <cstdint>
#include <vector>

namespace tidemark::cli {

/// The scene's sound from `start` on, left and right in turn, render::k_sample_rate a second each. An
/// interrupt cuts it short. A context must be current.
Result<std::vector<int16_t>> draw_sound(const scene::Scene& scene, glsl::Precision precision, double start,
                                        double duration, const Interrupt& interrupt);

Result<int> capture_sound(const SoundPlan& plan);

} // namespace tidemark::cli
