// Records what a pixel computes as it is evaluated, line by line, in bounded memory: of a long loop the first
// and the last few turns, and those in which something happens.
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
    /// Keeps the values of `line` (of the text that was compiled) alone.
    Recorder(const ir::Function& function, const PassLines& lines, std::optional<int> line,
             std::optional<TurnRange> turns);

    /// Behind each block that was executed.
    void record(const ir::LockstepEvaluator& evaluator, uint32_t block);

    /// Those that ran.
    std::vector<TracedLine> lines() const;
    /// What was kept; `function` knows the author's places.
    std::vector<LineInCall> calls(const PassFunction& function) const;

private:
    struct Loop {
        uint32_t header = 0;
        std::vector<bool> blocks{};
        uint32_t turn = 0;
    };
    /// A line with the measures that its figures come from.
    struct Line {
        TracedLine traced{};
        double worst = 0;        ///< relative spread of a value
        double largest_loss = 1; ///< factor by which an operation widened the spread
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
    std::vector<Loop> loops_;                   ///< outer ones first
    std::vector<std::vector<uint32_t>> around_; ///< the loops around each block
    std::optional<uint32_t> previous_;          ///< block
    std::vector<double> spreads_;               ///< of each instruction's result, relative
    std::map<int, Line> lines_;
    std::map<const ir::Assignment*, KeptValues> kept_;
    uint64_t order_ = 0;
};

} // namespace tidemark::lab
