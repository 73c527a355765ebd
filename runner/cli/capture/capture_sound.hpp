// `tidemark capture SCENE -o sound.wav`: writes the Sound pass to a file.
#pragma once

#include "base/file.hpp"
#include "cli/capture/capture_plan.hpp"
#include "cli/interrupt.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace tidemark::cli {

/// Returns the scene's sound from `start` on (seconds): interleaved left and right samples,
/// render::k_sample_rate of each a second. After an interrupt the rest is silent. A context must be current.
Result<std::vector<int16_t>> draw_sound(const scene::Scene& scene, glsl::Precision precision, double start,
                                        double duration, const Interrupt& interrupt);

/// Returns the sound during the frames of a video, as a WAV file. Errors are printed and the video is silent,
/// since pictures without sound are better than none.
std::optional<StagedFile> draw_sound_of_video(const CapturePlan& plan, const Interrupt& interrupt);

Result<int> capture_sound(const SoundPlan& plan);

} // namespace tidemark::cli
