// What a pass reads, as a set of numbers for each cell of its memory: what a frame has, but for what is set
// to a range.
#pragma once

#include "ir/interval.hpp"
#include "lab/march/drawn_pass.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

class InputRanges {
public:
    explicit InputRanges(const DrawnPass& drawn);

    /// Where the pass reads it.
    void set(std::string_view name, std::span<const ir::Interval> ranges);
    void set(std::string_view name, const ir::Interval& range);
    /// In pixels from the lower left corner.
    void set_place(const ir::Interval& x, const ir::Interval& y);
    /// Seconds; with it all that goes on with time.
    void set_time(const ir::Interval& time);
    /// All knobs that have a range, over the whole of it.
    void turn_knobs();

    const std::vector<ir::Interval>& memory() const { return memory_; }

private:
    const DrawnPass* drawn_;
    std::vector<ir::Interval> memory_;
};

/// What a sampler of the pass may give where that is not what the last frame left.
std::optional<ir::Interval> changing(const DrawnPass& drawn, const std::string& sampler);

} // namespace tidemark::lab
