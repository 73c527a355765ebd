// Finds faults in a scene for which fixes of the text may be known: places and candidate changes. It judges
// none of them. A context must be current.
#pragma once

#include "glsl/cure/cure.hpp"
#include "lab/check/probe_bench.hpp"
#include "lab/check/undefined_calls.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

struct Finding {
    enum class Kind {
        no_value,   ///< a variable is read before it is set
        not_finite, ///< a picture has a NaN or an infinity
        undefined,  ///< a function outside its domain, visible in the picture
        first_hit,  ///< rays proved to step over their first hit or to miss it
        budget,     ///< rays that run out of steps
        counter,    ///< a loop with a float counter that miscounts
        divergence, ///< a derivative where neighbouring pixels may have taken another branch
        rounding,   ///< a picture in float that differs from that in double
        hash,       ///< random numbers from large sines
    };
    Kind kind = Kind::no_value;
    std::string sentence;              ///< the fault and its place
    std::optional<FrameState> where{}; ///< a situation that shows it
    std::vector<glsl::Cure> cures{};   ///< the simplest first; empty: none is known
    bool only_a_warning = false;       ///< `check` only warns of it: not reported if no fix helps
};

struct CurableFindings {
    std::vector<Finding> all;
    std::vector<PictureView> views; ///< in which undefined calls were measured
    std::string left_out{};         ///< why the text was not analysed; empty: it was
};

/// Runs the analyses and probes that fixes exist for. `hashes`: also hashes of large sines, whose fixes
/// change the picture.
Result<CurableFindings> find_curable(ProbeBench& bench, bool hashes);

} // namespace tidemark::lab
