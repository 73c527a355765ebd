// Value range analysis: an interval for every value of a function, over all ways through it at once. Abstract
// interpretation with widening at the heads of loops (P. Cousot, R. Cousot: Abstract interpretation, POPL
// 1977), and what holds behind a condition taken into account.
#pragma once

#include "ir/evaluate.hpp"
#include "ir/interval.hpp"

#include <optional>
#include <vector>

namespace tidemark::ir {

/// An operation that may make NaN or an infinity of numbers: outside of its domain, at a pole, or because it
/// is not followed.
struct PartialOperation {
    Value value = k_no_value;
    std::vector<Interval> operands{};
};

struct ValueRanges {
    bool settled = false; ///< else it took too long, and nothing is known
    std::vector<Interval> memory{};
    /// For each cell of the memory: the first operation that may have put NaN or an infinity into it. Its
    /// value is k_no_value where that came from outside.
    std::vector<std::optional<PartialOperation>> partial{};
};

/// `memory` is what uniforms and inputs may be. As floats compute it: sums, products, quotients and roots
/// rounded once, functions to 1e-6, subnormal numbers kept or flushed. What is too large for a float counts
/// as a number.
ValueRanges value_ranges(const Function& function, const std::vector<Interval>& memory,
                         const Textures<Interval>& textures);

} // namespace tidemark::ir
