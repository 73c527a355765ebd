// `tidemark capture SCENE -o sound.wav`: what the Sound pass plays, as a file.
#pragma once

#include "base/file.hpp"
#include "cli/capture/capture_plan.hpp"
#include "cli/interrupt.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace tidemark::cli {

/// The scene's sound from `start` on, left and right in turn, render::k_sample_rate a second each. An
/// interrupt cuts it short. A context must be current.
Result<std::vector<int16_t>> draw_sound(const scene::Scene& scene, glsl::Precision precision, double start,
                                        double duration, const Interrupt& interrupt);

/// What the scene plays during the frames of a video, as a WAV file. Pictures without it are better than
/// none: what is wrong is said, and nothing else.
std::optional<StagedFile> draw_sound_of_video(const CapturePlan& plan, const Interrupt& interrupt);

Result<int> capture_sound(const SoundPlan& plan);

} // namespace tidemark::cli
