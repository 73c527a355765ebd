// Hits as the device computes them: a scene without a mainHit gets one that records, while mainImage runs,
// the first marching loop that each pixel enters. The pass in SSA form shows where to record; the recording
// is checked against the picture and against the pass evaluated on the CPU. Needs a current context.
#pragma once

#include "glsl/instrument/march_record.hpp"
#include "lab/march/pass_function.hpp"
#include "render/frame_state.hpp"

#include <cstddef>

namespace tidemark::lab {

/// Returns the place of a marching loop in its author's text.
glsl::MarchLines lines_of(const PassFunction& image, const ir::MarchingLoop& loop);

struct Recording {
    scene::Scene scene; ///< its Image is of kind hit; its last knob is glsl::k_record_knob
    /// Whether samples below the surface are recorded: false if the march ends only below it, or has fixed
    /// steps.
    bool sees_below = true;
    bool fixed_steps = false; ///< every march adds a constant
};

/// Instruments the scene. The error gives the reason why the march's place in the text is not known.
Result<Recording> record_hits(const scene::Scene& scene, const PassFunction& image);

/// Selects what the recording's renderer draws from now on.
void ask(render::Renderer& recording, glsl::RecordAnswer answer);

/// Result of the check, for the rays of a grid of pixels.
struct RecordingCheck {
    size_t rays = 0; ///< number that enter a marching loop, on the CPU
    /// of these, those that read a texture: its texels are not available, so they are not compared
    size_t textured = 0;
    /// of the others, those whose hit, iteration count and place equal the CPU's, up to rounding
    size_t agree = 0;
    size_t other_pixels = 0; ///< pixels of the picture that the recording text draws differently

    size_t compared() const { return rays - textured; }
};

/// `plain` and `recording` are the renderers of the scene and of the recording, of the same size.
RecordingCheck check_recording(render::Renderer& plain, render::Renderer& recording,
                               const PassFunction& image, const render::FrameState& state);
/// Returns the reason why the hits must not be used; empty if they may be.
std::string refusal_of(const RecordingCheck& check);

} // namespace tidemark::lab
