// Chooses the program that draws a sequence: one with optimisations that a driver may round differently, or
// the plain one. Both draw frames of the sequence; the bytes and the time decide. A moving picture in a
// window is a sequence without an end.
#pragma once

#include "base/error.hpp"
#include "render/renderer.hpp"

#include <functional>
#include <optional>
#include <string>

namespace tidemark::host {

/// The frames and limits of a trial.
struct TrialPlan {
    render::FrameInputs first{}; ///< first and last compared frame, each drawn with zeroed buffers
    render::FrameInputs last{};
    size_t frames = 1; ///< length of the sequence: a trial may cost a twentieth of it
    /// The largest allowed difference of a sample (0..1 in a picture). If set, the trial may take any time.
    std::optional<double> allowed{};
    /// Other work draws meanwhile: the last frame is timed until the gain is clear, instead of once.
    bool in_window = false;
};

struct Trial {
    render::Renderer renderer; ///< buffers zeroed
    /// Message about a difference that was allowed or that decided against it; may be empty.
    std::string said{};
    /// Time of a frame relative to the plain program, if the specialised program was chosen.
    std::optional<double> share{};
    bool in_doubt = false; ///< there were two programs, and another trial may decide otherwise
};

/// Returns the time of a frame relative to another program: the median of pairs, as soon as its whole 95 %
/// interval lies below `largest`. Returns nothing once the interval lies above it, or if `next_pair` ends
/// before the result is clear.
std::optional<double> clear_share(const std::function<std::optional<double>()>& next_pair, double largest);

/// Returns true if specialising with `how` changes the scene in a way that a driver may round differently;
/// otherwise a trial is pointless.
bool worth_trying(const render::Renderer& renderer, glsl::Specialise how);

/// Chooses the program; `options.specialise` is the strongest optimisation allowed.
Result<Trial> choose_program(const scene::Scene& scene, const render::RenderOptions& options,
                             const TrialPlan& plan);

} // namespace tidemark::host
