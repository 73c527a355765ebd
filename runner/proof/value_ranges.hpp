// Value range analysis: an interval for every value of a function, over all paths through it at once.
// Abstract interpretation with widening at loop headers (P. Cousot, R. Cousot: Abstract interpretation, POPL
// 1977), refined by the conditions that hold in each block.
#pragma once

#include "proof/evaluate.hpp"
#include "proof/interval.hpp"

#include <optional>
#include <vector>

namespace tidemark::proof {

/// An operation that may make NaN or an infinity from numbers: outside of its domain, at a pole, or because
/// it is not supported.
struct PartialOperation {
    Value value = k_no_value;
    std::vector<Interval> operands{};
};

struct ValueRanges {
    bool settled = false; ///< false: the iteration limit was reached and nothing is known
    std::vector<Interval> memory{};
    /// For each memory cell: the first operation that may have put NaN or an infinity into it. Its value is
    /// k_no_value if that came from outside.
    std::vector<std::optional<PartialOperation>> partial{};
};

/// `memory` holds the ranges of uniforms and inputs. Ranges include float rounding: sums, products, quotients
/// and roots rounded once, functions to 1e-6, subnormal numbers kept or flushed. Results too large for a
/// float count as numbers.
ValueRanges value_ranges(const Function& function, const std::vector<Interval>& memory,
                         const Textures<Interval>& textures);

} // namespace tidemark::proof
