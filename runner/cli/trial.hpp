// Which program draws a sequence: the one that was specialised in ways that a driver may round differently,
// or the one that the driver surely rounds alike. Both are tried on frames of the sequence, and the bytes
// decide. A window that moves is a sequence without an end.
#pragma once

#include "base/result.hpp"
#include "render/renderer.hpp"

#include <functional>
#include <optional>
#include <string>

namespace tidemark::cli {

/// What is tried.
struct TrialPlan {
    render::FrameInputs first{}; ///< of the frames that are looked at, drawn one after the other from zero
    render::FrameInputs last{};
    size_t frames = 1; ///< of the sequence: a trial may cost a twentieth of it
    /// The largest difference of a sample (0..1 in a picture) that is consented to, whatever the trial costs.
    std::optional<double> allowed{};
    /// Something else draws meanwhile: the last frame is timed until the gain is clear, else once.
    bool in_window = false;
};

struct Trial {
    render::Renderer renderer; ///< its buffers are zero
    std::string said{}; ///< for people: a difference that was allowed or that decided against it; else empty
    /// What a frame takes of the plain program's time, where the other one was taken.
    std::optional<double> share{};
    bool in_doubt = false; ///< there were two programs, and another trial may decide otherwise
};

/// What a frame takes of another program's time: the median of pairs, as soon as all of its 95 % interval
/// lies below `largest`. None where it lies above, or `next_pair` has no more before that is clear.
std::optional<double> clear_share(const std::function<std::optional<double>()>& next_pair, double largest);

/// Whether specialising as far as `how` does anything to the scene that is not surely drawn alike: else there
/// is no other program to try.
bool worth_trying(const render::Renderer& renderer, glsl::Specialise how);

/// `options.specialise` says how far it may go.
Result<Trial> choose_program(const scene::Scene& scene, const render::RenderOptions& options,
                             const TrialPlan& plan);

} // namespace tidemark::cli
