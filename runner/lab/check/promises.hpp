// What a scene promises of its numbers, in a file beside it (`waves.check.json` beside `waves.glsl`), so that
// `tidemark check` guards it. Without the file, these defaults are asked for.
#pragma once

#include "base/result.hpp"

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace tidemark::lab {

struct Promises {
    double time_horizon = 1e4;           ///< seconds up to which float and double show the same
    double most_exhausted_percent = 0.1; ///< rays that may run out of steps
    double most_overstep_percent = 0;    ///< rays that may take a sample below the surface
    double smoothest_jump = 10; ///< dB that an instant may be less like the next than before and after
    double space_horizon =
        1e3; ///< units from its place up to which a camera sees the same in float and double
    /// That march_field has along a ray, in its own unit a unit of distance; infinite: the scene states none.
    double largest_slope = std::numeric_limits<double>::infinity();
    std::set<std::string> stated; ///< those numbers that the file names
    /// What knobs and definitions without a range of their own, or with a wider one, may be set to.
    std::map<std::string, std::pair<double, double>> ranges;
    std::map<std::string, std::string> skip; ///< probe: why it is not asked
};

/// What the scene's text defines a name as, if it does.
using DefinitionOf = std::function<std::optional<std::string>(const std::string& name)>;

/// Reads such a file; `file` is named in the errors (ErrorCode::load), with the name of the value.
Result<Promises> parse_promises(std::string_view text, const std::string& file,
                                const DefinitionOf& definition_of);

} // namespace tidemark::lab
