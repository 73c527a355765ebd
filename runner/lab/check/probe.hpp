// Questions about the numbers of a scene, each with a verdict: what `tidemark check` asks. A probe looks, and
// leaves the scene as it is.
#pragma once

#include "base/result.hpp"
#include "lab/check/probe_bench.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tidemark::lab {

/// `cut`: it was not asked, or not until it answered.
enum class Verdict { pass, warn, fail, not_applicable, cut };
std::string_view to_string(Verdict verdict);

struct Answer {
    Verdict verdict = Verdict::pass;
    std::string sentence; ///< what was found; why the probe does not apply
    /// Where it shows first, and what it looks like there, with the pixels or rays in question in magenta.
    std::optional<FrameState> where{};
    std::optional<image::Image> picture{};
    bool non_finite = false; ///< a NaN or an infinity is there, which can be traced to its origin
};

struct Probe {
    std::string_view name;
    std::string_view about; ///< what it looks at and when it fails
    /// An error is one of the scene (it does not compile so), not of its numbers.
    Result<Answer> (*ask)(ProbeBench& bench);
};

/// In the order they are asked: the cheap ones first.
std::span<const Probe> all_probes();

/// Today's name of a probe that version 0.1 called so; of any other word the word itself.
std::string_view probe_name(std::string_view name);

} // namespace tidemark::lab
