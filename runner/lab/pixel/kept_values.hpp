// The values of one place in a text that are kept of all that it computed: the first and the last few, and
// those in which something happens; or those of the turns that were asked for.
#pragma once

#include "lab/pixel/traced_line.hpp"

#include <deque>
#include <optional>
#include <vector>

namespace tidemark::lab {

class KeptValues {
public:
    /// In order of execution; gives it its number.
    void add(TracedValue value, const std::optional<TurnRange>& turns);
    /// In order of execution, each one once.
    std::vector<TracedValue> all() const;

private:
    uint64_t count_ = 0;
    std::vector<TracedValue> first_;
    std::deque<TracedValue> last_;
    /// The first of its kind each; `fewest_` digits.
    std::optional<TracedValue> not_finite_, mismatch_, unstable_, fewest_;
};

} // namespace tidemark::lab
