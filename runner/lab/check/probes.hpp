// The probe functions, by subject. The table in lab/check/probe.cpp describes each, also for users.
#pragma once

#include "lab/check/probe.hpp"

namespace tidemark::lab {

// probes_finite.cpp
Result<Answer> ask_times(ProbeBench& bench);
Result<Answer> ask_frames(ProbeBench& bench);
Result<Answer> ask_mouse(ProbeBench& bench);
Result<Answer> ask_sizes(ProbeBench& bench);
Result<Answer> ask_knobs(ProbeBench& bench);
Result<Answer> ask_search(ProbeBench& bench);

// probes_no_nan.cpp
Result<Answer> ask_no_nan(ProbeBench& bench);

// probes_inputs.cpp
Result<Answer> ask_inputs(ProbeBench& bench);

// probes_undefined.cpp
Result<Answer> ask_undefined(ProbeBench& bench);
Result<Answer> ask_bounds(ProbeBench& bench);

// probes_text.cpp
Result<Answer> ask_unassigned(ProbeBench& bench);
Result<Answer> ask_divergence(ProbeBench& bench);
Result<Answer> ask_counters(ProbeBench& bench);

// probes_time.cpp
Result<Answer> ask_horizon(ProbeBench& bench);
Result<Answer> ask_time_discontinuity(ProbeBench& bench);
Result<Answer> ask_hashes(ProbeBench& bench);

// probes_tiles.cpp
Result<Answer> ask_tiles(ProbeBench& bench);

// probes_motion.cpp
Result<Answer> ask_repeats(ProbeBench& bench);
Result<Answer> ask_threads(ProbeBench& bench);
Result<Answer> ask_camera(ProbeBench& bench);
Result<Answer> ask_mouse_edge(ProbeBench& bench);

// probes_portable.cpp
Result<Answer> ask_sine(ProbeBench& bench);
Result<Answer> ask_rounding(ProbeBench& bench);
Result<Answer> ask_mediump(ProbeBench& bench);

// probes_hit.cpp
Result<Answer> ask_overstep(ProbeBench& bench);
Result<Answer> ask_budget(ProbeBench& bench);
Result<Answer> ask_lipschitz_sweep(ProbeBench& bench);

// probes_drift.cpp
Result<Answer> ask_drift(ProbeBench& bench);

// probes_proved.cpp
Result<Answer> ask_first_hit(ProbeBench& bench);
Result<Answer> ask_step_scale(ProbeBench& bench);
Result<Answer> ask_turns(ProbeBench& bench);

// probes_rays.cpp
Result<Answer> ask_rays(ProbeBench& bench);
Result<Answer> ask_epsilon(ProbeBench& bench);
Result<Answer> ask_octaves(ProbeBench& bench);
Result<Answer> ask_self_intersection(ProbeBench& bench);

// probes_place.cpp
Result<Answer> ask_grazing(ProbeBench& bench);
Result<Answer> ask_places(ProbeBench& bench);
Result<Answer> ask_far(ProbeBench& bench);

// probes_gradient.cpp
Result<Answer> ask_gradient(ProbeBench& bench);

// probes_slope.cpp
Result<Answer> ask_normals(ProbeBench& bench);

} // namespace tidemark::lab
