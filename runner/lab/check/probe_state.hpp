// The states in which probes look at a scene.
#pragma once

#include "lab/setting.hpp"
#include "render/frame_state.hpp"
#include "scene/scene.hpp"

#include <vector>

namespace tidemark::lab {

using render::FrameState;

/// Small: probes draw hundreds of pictures.
inline constexpr Extent k_probe_extent{64, 36};

/// As the scene stands, at a time.
FrameState state_at(double seconds, Extent extent = k_probe_extent);
/// One second in.
FrameState plain_state(Extent extent = k_probe_extent);
/// The moments that `times` looks at, from 0 to 16777216 s and one before 0: for any probe that samples time.
std::vector<FrameState> usual_moments();
FrameState with_mouse(render::Mouse mouse, FrameState state = plain_state());

/// From here on a scene with feedback is drawn: from its start would take days, where nobody asks for a
/// certain frame.
int first_frame_of(const FrameState& state);

/// With the state's channels, knobs and definitions. The error is one of theirs (ErrorCode::usage).
Result<scene::Scene> in_state(scene::Scene scene, const FrameState& state);

} // namespace tidemark::lab
