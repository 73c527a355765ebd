// Probes: the checks that `tidemark check` runs, each with a verdict on a scene's numbers. A probe does not
// change the scene.
#pragma once

#include "base/error.hpp"
#include "lab/probe_bench.hpp"

#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

/// `fail`: the picture is wrong on this device, or proved wrong. `warn`: it is wrong on a named other device,
/// with a named input or at a named time. `note`: anything else worth knowing. `cut`: the time budget ran out
/// before or while the probe ran.
enum class Verdict { pass, note, warn, fail, not_applicable, cut };
std::string_view to_string(Verdict verdict);

/// Returns true for `note`, `warn` and `fail`.
bool is_finding(Verdict verdict);

/// The subject of a probe's findings. Findings of one family that name a common line, or no line, have one
/// cause.
enum class Family {
    alone,
    numbers,
    sines,
    clock,
    steps,
    iterations,
    garbage ///< undefined results, after which any bytes may be drawn
};

/// The command that a finding offers to its reader.
enum class Remedy {
    none,
    show,       ///< `capture`: draws the frame that shows it
    fix,        ///< `check --fix`
    fix_hashes, ///< `check --fix --hashes`
};

/// A finding in the words of a shader's author.
struct PlainWords {
    Family family = Family::alone;
    std::string_view effect; ///< what a viewer sees: a clause without a full stop
    std::string_view cause;  ///< why, as a clause; empty: the effect says it
    Remedy remedy = Remedy::show;
};

struct Answer {
    Verdict verdict = Verdict::pass;
    std::string sentence{}; ///< what was found, or why the probe does not apply
    /// The first situation that shows the finding and its picture, with the affected pixels or rays in
    /// magenta.
    std::optional<FrameState> where{};
    std::optional<image::Image> picture{};
    bool non_finite = false; ///< there is a NaN or an infinity, whose origin can be traced
    /// Instead of the words in Probe::plain; no effect: those.
    std::string effect{};
    std::string cause{};
    /// The lines to change, the most important first; empty: not known.
    std::vector<SourceLocation> places{};
};

/// Adds a line, once and without its column; not one that Tidemark added to the text.
void add_place(Answer& answer, SourceLocation where);

struct Probe {
    std::string_view name;
    std::string_view about; ///< what it checks and when it fails
    /// Fails if the scene does not compile in the way that the probe needs; faulty numbers are an Answer.
    Result<Answer> (*ask)(ProbeBench& bench);
    PlainWords plain{};
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
Result<Answer> ask_edges(ProbeBench& bench);
Result<Answer> ask_seams(ProbeBench& bench);

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
/// Returns whether the picture changes visibly if these functions are computed with fused multiply-adds.
Result<bool> depends_on_contraction(ProbeBench& bench, const std::set<std::string>& functions);

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
