// What the probes find in a scene and a text could be cured of: places, and what could be written there. A
// context must be current.
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
        no_value,   ///< read before it has one
        not_finite, ///< NaN or infinity in a picture
        undefined,  ///< a function outside of its domain, and visible
        first_hit,  ///< rays that step over their first hit or miss it, by proof
        budget,     ///< rays that run out of steps
        counter,    ///< a loop that counts in floats, and wrongly
        divergence, ///< a derivative where neighbours may have taken another branch
        rounding,   ///< a picture in float that is off from that in double
        hash,       ///< random numbers from large sines
    };
    Kind kind = Kind::no_value;
    std::string sentence;              ///< what is wrong, and where
    std::optional<FrameState> where{}; ///< in which it shows
    std::vector<glsl::Cure> cures{};   ///< the plainest first; empty: none is known
    bool only_a_warning = false;       ///< of check: not told where nothing mends it
};

struct CurableFindings {
    std::vector<Finding> all;
    std::vector<PictureView> views; ///< in which calls were looked at
    std::string left_out{};         ///< why the text was not followed; empty: it was
};

/// `hashes`: those, too, whose cure is another picture.
Result<CurableFindings> find_curable(ProbeBench& bench, bool hashes);

} // namespace tidemark::lab
