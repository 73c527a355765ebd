// Probes: the checks that `tidemark check` runs, each with a verdict on a scene's numbers. A probe does not
// change the scene.
#pragma once

#include "base/result.hpp"
#include "lab/check/probe_bench.hpp"

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

/// Returns the current name of a probe that had another name in version 0.1; other names are returned
/// unchanged.
std::string_view probe_name(std::string_view name);

} // namespace tidemark::lab
