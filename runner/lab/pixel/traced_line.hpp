// The values that lines of a text computed for one pixel, as plain data.
#pragma once

#include "base/error.hpp"
#include "ir/stochastic_system.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::lab {

/// A line of the author's text.
struct AuthorLine {
    SourceLocation where;
    std::string text{}; ///< without surrounding blanks
};

/// Iteration numbers of the loops around a place, outermost first, from 1; empty outside of loops.
using Turns = std::vector<uint32_t>;
/// First and last iteration of the innermost loop.
using TurnRange = std::pair<uint32_t, uint32_t>;

/// One value that was assigned to a variable, or computed on a line without one.
struct TracedValue {
    enum class Kind { real, whole, condition } kind = Kind::real;
    std::string name{}; ///< for example `p`, `hit.normal`, `heights[3]`
    bool carried = false; ///< from one iteration of the loop to the next
    Turns turns{}; ///< iterations in which it was computed
    uint32_t rows = 1; ///< of a vector or a matrix
    std::vector<double> in_float{}; ///< column by column; a condition is 1 or 0
    std::vector<double> in_double{};
    double digits = 0; ///< that rounding leaves correct; of a vector relative to its length
    bool unstable = false; ///< a condition or a whole number that depends on rounding
    uint64_t order = 0; ///< position among all values of the pixel
    uint64_t number = 0; ///< position among the values of the same place, from 1

    /// Returns whether all components are finite in float.
    bool finite() const;
    /// Returns whether a condition or a whole number differs in double.
    bool mismatch() const;
};

/// The values of a line in one call of its function.
struct LineInCall {
    std::string function{};
    std::vector<SourceLocation> callers{}; ///< places of the enclosing calls, innermost first
    std::vector<TracedValue> values{}; ///< in order of execution
};

/// An event on a line: how often it happened, and the iterations of the first time.
struct Occurrence {
    uint64_t times = 0;
    Turns first{};
};

/// The summary of one line.
struct TracedLine {
    AuthorLine line{};
    uint64_t values = 0; ///< number of named values computed
    double digits = ir::k_most_digits; ///< of the value with the fewest
    std::string fewest{}; ///< name of that value
    Turns fewest_turns{};
    double lost = 0; ///< digits lost by one operation: how many fewer its result has than its operands
    Turns lost_turns{};
    std::optional<TracedValue> not_finite{}; ///< the first such value
    Occurrence mismatch{}; ///< a condition whose value in double differs
    bool float_holds = false; ///< that condition in float
    Occurrence unstable{}; ///< a condition that depends on rounding
};

} // namespace tidemark::lab
