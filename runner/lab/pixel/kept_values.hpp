// Keeps a bounded selection of the values computed at one place of a text: the first and last few, and those
// with an event; or those of the requested iterations.
#pragma once

#include "lab/pixel/traced_line.hpp"

#include <deque>
#include <optional>
#include <vector>

namespace tidemark::lab {

class KeptValues {
public:
    /// Adds the next value in order of execution, and numbers it.
    void add(TracedValue value, const std::optional<TurnRange>& turns);
    /// Returns the kept values in order of execution, each once.
    std::vector<TracedValue> all() const;

private:
    uint64_t count_ = 0;
    std::vector<TracedValue> first_;
    std::deque<TracedValue> last_;
    /// The first value with each event; `fewest_`: with the fewest digits.
    std::optional<TracedValue> not_finite_, mismatch_, unstable_, fewest_;
};

} // namespace tidemark::lab
