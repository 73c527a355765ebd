// Hits as the device makes them: a scene without a mainHit gets one that records the first marching loop of
// its Image while mainImage runs. Where to record is known from the pass in SSA form; what was recorded is
// held against the picture and against the pass evaluated on the CPU. A context must be current for that.
#pragma once

#include "glsl/instrument/march_record.hpp"
#include "lab/march/pass_function.hpp"
#include "render/frame_state.hpp"

#include <cstddef>

namespace tidemark::lab {

/// Where a marching loop stands in its author's text.
glsl::MarchLines lines_of(const PassFunction& image, const ir::MarchingLoop& loop);

struct Recording {
    scene::Scene scene; ///< its Image is of kind hit; its last knob is glsl::k_record_knob
    /// Whether a sample below the surface shows: not where the march waits for one, or goes in fixed steps.
    bool sees_below = true;
    bool fixed_steps = false; ///< every march goes on by a constant
};

/// The error says why it is not known where the march stands in the text.
Result<Recording> record_hits(const scene::Scene& scene, const PassFunction& image);

/// What a recording's renderer draws from now on.
void ask(render::Renderer& recording, glsl::RecordAnswer answer);

/// Of the rays of a grid of pixels.
struct RecordingCheck {
    size_t rays = 0;     ///< that enter a marching loop, on the CPU
    size_t textured = 0; ///< of them: read a texture, whose texels are not followed, and are not compared
    size_t agree = 0;    ///< of the others: hit or not, turns and place are those of the CPU, to a rounding
    size_t other_pixels = 0; ///< of the picture: drawn otherwise by the text that records

    size_t compared() const { return rays - textured; }
};

/// `plain` and `recording` are the scene's and the recording's renderers, of one size.
RecordingCheck check_recording(render::Renderer& plain, render::Renderer& recording,
                               const PassFunction& image, const render::FrameState& state);
/// Why its hits are not to be used; empty: they are.
std::string refusal_of(const RecordingCheck& check);

} // namespace tidemark::lab
