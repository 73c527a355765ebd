// What lines of a text computed in one pixel, as plain values.
#pragma once

#include "base/error.hpp"
#include "ir/stochastic_system.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::lab {

/// A line as its author has it.
struct AuthorLine {
    SourceLocation where;
    std::string text{}; ///< without the blanks around it
};

/// Of the loops around a place, outermost first, from 1; empty outside of loops.
using Turns = std::vector<uint32_t>;
/// Of the innermost loop, from the first to the last.
using TurnRange = std::pair<uint32_t, uint32_t>;

/// What a variable, or a line without one, was given at one time.
struct TracedValue {
    enum class Kind { real, whole, condition } kind = Kind::real;
    std::string name{};             ///< as in `p`, `hit.normal`, `heights[3]`
    bool carried = false;           ///< from one turn of the loop to the next
    Turns turns{};                  ///< when
    uint32_t rows = 1;              ///< of a vector or a matrix
    std::vector<double> in_float{}; ///< columns first; of a condition 1 or 0
    std::vector<double> in_double{};
    double digits = 0;     ///< that rounding leaves, of a vector in relation to its length
    bool unstable = false; ///< a condition or a whole number that rounding alone decides
    uint64_t order = 0;    ///< among all values of the pixel
    uint64_t number = 0;   ///< among those of the same place, from 1

    /// In float.
    bool finite() const;
    /// A condition or a whole number that is another one in double.
    bool mismatch() const;
};

/// The values of a line in one call of its function.
struct LineInCall {
    std::string function{};
    std::vector<SourceLocation> callers{}; ///< places of the calls that led here, innermost first
    std::vector<TracedValue> values{};     ///< in order of execution
};

/// Something that happened on a line: how often, and when first.
struct Occurrence {
    uint64_t times = 0;
    Turns first{};
};

/// What happened on one line.
struct TracedLine {
    AuthorLine line{};
    uint64_t values = 0;               ///< that were computed and have a name
    double digits = ir::k_most_digits; ///< of the value that has fewest
    std::string fewest{};              ///< its name
    Turns fewest_turns{};
    double lost = 0; ///< digits that the result of one operation had less than its operands
    Turns lost_turns{};
    std::optional<TracedValue> not_finite{}; ///< the first
    Occurrence mismatch{};                   ///< a condition that double decides otherwise
    bool float_holds = false;                ///< that condition in float
    Occurrence unstable{};                   ///< a condition that rounding alone decides
};

} // namespace tidemark::lab
