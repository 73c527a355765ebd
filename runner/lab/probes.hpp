// Probes: the checks that `tidemark check` runs, each with a verdict on a scene's numbers. A probe does not
// change the scene.
#pragma once

#include "base/error.hpp"
#include "lab/probe_bench.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tidemark::lab {

/// `cut`: the time budget ran out before or while the probe ran.
enum class Verdict { pass, warn, fail, not_applicable, cut };
std::string_view to_string(Verdict verdict);

struct Answer {
    Verdict verdict = Verdict::pass;
    std::string sentence; ///< what was found, or why the probe does not apply
    /// The first situation that shows the finding and its picture, with the affected pixels or rays in
    /// magenta.
    std::optional<FrameState> where{};
    std::optional<image::Image> picture{};
    bool non_finite = false; ///< there is a NaN or an infinity, whose origin can be traced
};

struct Probe {
    std::string_view name;
    std::string_view about; ///< what it checks and when it fails
    /// Fails if the scene does not compile in the way that the probe needs; faulty numbers are an Answer.
    Result<Answer> (*ask)(ProbeBench& bench);
};

/// Returns all probes in the order in which they run: the cheap ones first.
std::span<const Probe> all_probes();

// The probe functions, by subject. The table in lab/probes.cpp describes each, also for users.

// probes_finite.cpp
Result<Answer> ask_times(ProbeBench& bench);
Result<Answer> ask_frames(ProbeBench& bench);
Result<Answer> ask_mouse(ProbeBench& bench);
Result<Answer> ask_sizes(ProbeBench& bench);
Result<Answer> ask_knobs(ProbeBench& bench);
Result<Answer> ask_search(ProbeBench& bench);

// probes_finite.cpp
Result<Answer> ask_no_nan(ProbeBench& bench);

// probes_finite.cpp
Result<Answer> ask_inputs(ProbeBench& bench);

// undefined_calls.cpp
Result<Answer> ask_undefined(ProbeBench& bench);
Result<Answer> ask_bounds(ProbeBench& bench);

// text_findings.cpp
Result<Answer> ask_unassigned(ProbeBench& bench);
Result<Answer> ask_divergence(ProbeBench& bench);
Result<Answer> ask_counters(ProbeBench& bench);

// instrumented_pass.cpp
Result<Answer> ask_loop_ends(ProbeBench& bench);

// probes_continuity.cpp
Result<Answer> ask_horizon(ProbeBench& bench);
Result<Answer> ask_time_discontinuity(ProbeBench& bench);
Result<Answer> ask_hashes(ProbeBench& bench);

// probes_continuity.cpp
Result<Answer> ask_tiles(ProbeBench& bench);

// probes_continuity.cpp
Result<Answer> ask_repeats(ProbeBench& bench);
Result<Answer> ask_threads(ProbeBench& bench);
Result<Answer> ask_camera(ProbeBench& bench);
Result<Answer> ask_mouse_edge(ProbeBench& bench);

// probes_portable.cpp
Result<Answer> ask_sine(ProbeBench& bench);
Result<Answer> ask_rounding(ProbeBench& bench);
Result<Answer> ask_mediump(ProbeBench& bench);

// probes_hits.cpp
Result<Answer> ask_overstep(ProbeBench& bench);
Result<Answer> ask_budget(ProbeBench& bench);
Result<Answer> ask_lipschitz_sweep(ProbeBench& bench);

// probes_hits.cpp
Result<Answer> ask_drift(ProbeBench& bench);

// probes_proved.cpp
Result<Answer> ask_first_hit(ProbeBench& bench);
Result<Answer> ask_step_scale(ProbeBench& bench);
Result<Answer> ask_turns(ProbeBench& bench);

// probes_hits.cpp
Result<Answer> ask_rays(ProbeBench& bench);
Result<Answer> ask_epsilon(ProbeBench& bench);
Result<Answer> ask_octaves(ProbeBench& bench);
Result<Answer> ask_self_intersection(ProbeBench& bench);

// probes_place.cpp
Result<Answer> ask_grazing(ProbeBench& bench);
Result<Answer> ask_places(ProbeBench& bench);
Result<Answer> ask_far(ProbeBench& bench);

// probes_slope.cpp
Result<Answer> ask_gradient(ProbeBench& bench);

// probes_slope.cpp
Result<Answer> ask_normals(ProbeBench& bench);

} // namespace tidemark::lab
