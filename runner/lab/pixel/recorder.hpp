// Records a pixel's values while it is evaluated, line by line, in bounded memory: for a long loop the first
// and last few iterations, and those with an event.
#pragma once

#include "ir/lockstep_system.hpp"
#include "lab/pixel/kept_values.hpp"
#include "lab/pixel/pass_lines.hpp"
#include "lab/pixel/traced_line.hpp"

#include <map>
#include <optional>
#include <vector>

namespace tidemark::lab {

class Recorder {
public:
    /// Keeps only the values of `line`, a line of the compiled text.
    Recorder(const ir::Function& function, const PassLines& lines, std::optional<int> line,
             std::optional<TurnRange> turns);

    /// Call it after each executed block.
    void record(const ir::LockstepEvaluator& evaluator, uint32_t block);

    /// Returns the lines that ran.
    std::vector<TracedLine> lines() const;
    /// Returns the kept values; `function` converts lines to the author's.
    std::vector<LineInCall> calls(const PassFunction& function) const;

private:
    struct Loop {
        uint32_t header = 0;
        std::vector<bool> blocks{};
        uint32_t turn = 0;
    };
    /// A line and the extremes that its figures come from.
    struct Line {
        TracedLine traced{};
        double worst = 0; ///< largest relative spread of a value
        double largest_loss = 1; ///< largest factor by which an operation widened the spread
    };

    void count_turns(uint32_t block);
    Turns turns(uint32_t block) const;
    void measure_losses(const ir::LockstepEvaluator& evaluator, uint32_t block);
    double widening(const ir::Instruction& instruction, double spread) const;
    void compare_conditions(const ir::LockstepEvaluator& evaluator, uint32_t block);
    void compare(const ir::Lockstep& condition, int line, uint32_t block);
    void take(const ir::LockstepEvaluator& evaluator, const ir::Assignment& each);
    Line* line(int number);
    LineInCall call(uint32_t index, const PassFunction& function) const;

    const ir::Function* function_;
    const PassLines* source_;
    std::optional<int> wanted_;
    std::optional<TurnRange> range_;
    std::vector<Loop> loops_; ///< outer loops first
    std::vector<std::vector<uint32_t>> around_; ///< for each block: the loops around it
    std::optional<uint32_t> previous_; ///< the previous block
    std::vector<double> spreads_; ///< relative spread of each instruction's result
    std::map<int, Line> lines_;
    std::map<const ir::Assignment*, KeptValues> kept_;
    uint64_t order_ = 0;
};

} // namespace tidemark::lab
