// The limits that a scene promises to keep, read from a file beside it (`waves.check.json` for `waves.glsl`)
// and checked by `tidemark check`. Without the file the defaults below apply.
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
    double time_horizon = 1e4;           ///< seconds up to which float and double must look the same
    double most_exhausted_percent = 0.1; ///< percent of the rays that may run out of steps
    double most_overstep_percent = 0;    ///< percent of the rays that may take a sample below the surface
    /// DB by which the PSNR of two neighbouring instants may drop below that of the instants around them.
    double smoothest_jump = 10;
    double space_horizon =
        1e3; ///< world units from its place up to which a camera must see the same in float and double
    /// Largest slope of march_field along a ray, per world unit; infinite: the scene states none.
    double largest_slope = std::numeric_limits<double>::infinity();
    std::set<std::string> stated; ///< the numbers above that the file sets
    /// Ranges for knobs and definitions that have none of their own; they also replace a knob's own range.
    std::map<std::string, std::pair<double, double>> ranges;
    std::map<std::string, std::string> skip; ///< probe: the reason for skipping it
};

/// Returns a name's definition in the scene's text, if there is one.
using DefinitionOf = std::function<std::optional<std::string>(const std::string& name)>;

/// Parses the text of such a file. Errors (ErrorCode::load) name `file` and the entry.
Result<Promises> parse_promises(std::string_view text, const std::string& file,
                                const DefinitionOf& definition_of);

} // namespace tidemark::lab
