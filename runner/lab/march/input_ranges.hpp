// The inputs of a pass as an interval for each memory cell: the frame's own value unless it is set to a
// range.
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

    /// Sets a variable's components; no effect if the pass does not read it.
    void set(std::string_view name, std::span<const ir::Interval> ranges);
    void set(std::string_view name, const ir::Interval& range);
    /// In pixels from the lower left corner.
    void set_place(const ir::Interval& x, const ir::Interval& y);
    /// In seconds. Also sets the ranges of the uniforms that follow the time.
    void set_time(const ir::Interval& time);
    /// Sets all knobs that have a range to the whole of it.
    void turn_knobs();

    const std::vector<ir::Interval>& memory() const { return memory_; }

private:
    const DrawnPass* drawn_;
    std::vector<ir::Interval> memory_;
};

/// Returns the range of a sampler whose values change over time; nullopt if it keeps those of the last frame.
std::optional<ir::Interval> changing(const DrawnPass& drawn, const std::string& sampler);

} // namespace tidemark::lab
