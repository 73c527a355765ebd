// The states in which probes draw a scene.
#pragma once

#include "lab/setting.hpp"
#include "render/frame_state.hpp"
#include "scene/scene.hpp"

#include <vector>

namespace tidemark::lab {

using render::FrameState;

/// Small, as probes draw hundreds of pictures.
inline constexpr Extent k_probe_extent{64, 36};

/// Returns the unchanged scene at a time.
FrameState state_at(double seconds, Extent extent = k_probe_extent);
/// Returns the state at 1 s.
FrameState plain_state(Extent extent = k_probe_extent);
/// Returns the moments of the probe `times`, from 0 to 16777216 s and one before 0, for any probe that
/// samples time.
std::vector<FrameState> usual_moments();
FrameState with_mouse(render::Mouse mouse, FrameState state = plain_state());

/// Returns the frame from which a scene with feedback is drawn: 8 before the state's if the state gives a
/// time, since drawing from the start could take days; 0 if it gives a frame only.
int first_frame_of(const FrameState& state);

/// Returns the scene with the state's channels, knobs and definitions applied. Fails if one of them is
/// invalid (ErrorCode::usage).
Result<scene::Scene> in_state(scene::Scene scene, const FrameState& state);

} // namespace tidemark::lab
