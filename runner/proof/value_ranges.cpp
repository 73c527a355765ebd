#include "proof/value_ranges.hpp"

#include "proof/number_systems.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace tidemark::proof {
namespace {

constexpr int k_most_sweeps = 100;
constexpr int k_narrowings = 12;
/// Values that grow more often than this are widened.
constexpr int k_patience = 3;
/// Bounds that are tried before a value becomes unbounded.
constexpr std::array k_steps{-1e6, -1e3, -1.0, 0.0, 1.0, 1e3, 1e6};
/// How many operations back a value is computed again under a condition.
constexpr int k_depth = 2;

/// A condition that holds, or does not hold, throughout a block.
struct Fact {
    Value condition = k_no_value;
    bool holds = false;

    auto operator<=>(const Fact&) const = default; // NOLINT(modernize-use-nullptr): of the C++ within
};
using Facts = std::vector<Fact>; ///< sorted

/// Widens outwards to one of a few fixed bounds, so the analysis of a loop terminates.
Interval widened_to_steps(const Interval& before, Interval now) {
    if (now.low < before.low) {
        const auto step = std::ranges::find_if(k_steps.rbegin(), k_steps.rend(),
                                               [&](double each) { return each <= now.low; });
        now.low = step == k_steps.rend() ? -k_infinity : *step;
    }
    if (now.high > before.high) {
        const auto step = std::ranges::find_if(k_steps, [&](double each) { return each >= now.high; });
        now.high = step == k_steps.end() ? k_infinity : *step;
    }
    return now;
}

/// Relative error of a rounded result: twice that of rounding to nearest in float.
constexpr double k_float_rounding = 0x1p-23;
/// Relative error of functions and of composite operations: some units in the last place.
constexpr double k_function_rounding = 1e-6;
/// Smaller floats may be flushed to 0.
constexpr double k_least_float = 0x1p-126;
constexpr double k_largest_float = std::numeric_limits<float>::max();

bool is_rounded_once(Op op) {
    return op == Op::add || op == Op::subtract || op == Op::multiply || op == Op::divide ||
           op == Op::square || op == Op::sqrt || op == Op::to_real;
}
bool is_exact(Op op) {
    return op == Op::negate || op == Op::absolute || op == Op::sign || op == Op::minimum ||
           op == Op::maximum || op == Op::floor || op == Op::ceil || op == Op::truncate || op == Op::round ||
           op == Op::round_even || op == Op::select || op == Op::narrowed || op == Op::bits_as;
}

bool is_rest(Op op) {
    return op == Op::modulo || op == Op::remainder || op == Op::nearest_rest || op == Op::whole_multiple;
}

/// Returns the range of a float result from that in real arithmetic. Rounding does not change signs, except
/// of remainders; sines and cosines stay within 1.
Interval in_floats(Op op, Interval range, double largest_operand) {
    const bool once = is_rounded_once(op), wave = op == Op::sin || op == Op::cos;
    const double part = once ? k_float_rounding : k_function_rounding;
    const double slack = op == Op::mix || is_rest(op) ? k_function_rounding * largest_operand : 0;
    const auto down = [&](double bound) {
        const double lower = bound - part * std::abs(bound) - (bound == 0 && !is_rest(op) ? 0 : slack);
        return lower > 0 && lower < k_least_float ? 0.0 : bound > 0 ? std::max(lower, 0.0) : lower;
    };
    range = {down(range.low), -down(-range.high), range.partial};
    return wave ? Interval{std::max(range.low, -1.0), std::min(range.high, 1.0), range.partial} : range;
}

bool is_same(const Interval& a, const Interval& b) {
    return a.low == b.low && a.high == b.high && a.partial == b.partial;
}

/// A memory cell.
struct Cell {
    Interval range{};
    Value origin = k_no_value; ///< operation that may have made it NaN or infinite
};

class Analysis {
public:
    Analysis(const Function& function, const std::vector<Interval>& memory,
             const Textures<Interval>& textures)
        : function_(function), textures_(textures), values_(function.instructions.size()),
          origins_(function.instructions.size(), k_no_value), grown_(function.instructions.size()),
          reached_(function.blocks.size()), facts_(function.blocks.size()), memory_grown_(memory.size(), 1) {
        for (const Interval& range : memory)
            initial_.push_back({range});
        memory_ = initial_;
    }

    ValueRanges run() {
        if (function_.blocks.empty())
            return {};
        for (uint32_t i = 0; i < function_.blocks[0].first; ++i)
            values_[i] =
                IntervalSystem::constant(function_.instructions[i].immediate, function_.instructions[i].type);
        reached_[0] = true;
        if (!settles())
            return {};
        phase_ = Phase::narrowing;
        for (int i = 0; i < k_narrowings; ++i) {
            written_ = initial_;
            sweep();
            memory_ = written_;
        }
        phase_ = Phase::doubting;
        forget_doubts();
        sweep(); // phis read the values of the previous sweep
        return settles() ? result() : ValueRanges{};
    }

private:
    /// Bounds grow until they hold, then shrink as far as they still do. A doubt (NaN or infinity) that a
    /// loop passes on to itself would stay, so the last phase finds doubts again, within those bounds.
    enum class Phase { growing, narrowing, doubting };

    bool settles() {
        for (int i = 0; i < k_most_sweeps; ++i) {
            changed_ = false;
            sweep();
            if (!changed_)
                return true;
        }
        return false;
    }

    void forget_doubts() {
        for (Value value = function_.blocks[0].first; value < values_.size(); ++value)
            values_[value].partial = false;
        for (size_t cell = 0; cell < memory_.size(); ++cell)
            memory_[cell] = {
                {memory_[cell].range.low, memory_[cell].range.high, initial_[cell].range.partial}};
    }

    ValueRanges result() const {
        ValueRanges ranges{.settled = true};
        for (const Cell& cell : memory_) {
            ranges.memory.push_back(cell.range);
            ranges.partial.push_back(cell.range.partial ? std::optional(operation(cell.origin))
                                                        : std::nullopt);
        }
        return ranges;
    }

    PartialOperation operation(Value value) const {
        PartialOperation partial{value, {}};
        if (value == k_no_value)
            return partial;
        for (const Value operand : function_.operands_of(function_.instructions[value]))
            partial.operands.push_back(values_[operand]);
        return partial;
    }

    void sweep() {
        for (uint32_t i = 0; i < function_.blocks.size(); ++i) {
            if (!reached_[i])
                continue;
            const Block& block = function_.blocks[i];
            facts_[i] = facts_of(i);
            for (Value value = block.first; value < block.last; ++value)
                function_.instructions[value].op == Op::phi ? merge(i, value) : compute(i, value);
            leave(i);
        }
    }

    /// Marks the successors that may be reached.
    void leave(uint32_t block) {
        const Block& here = function_.blocks[block];
        std::optional<bool> way;
        if (here.end == Block::End::branch)
            way = IntervalSystem::decide(under(here.condition, facts_[block]));
        for (size_t i = 0; i < here.successors.size(); ++i) {
            if (way && *way != (i == 0))
                continue;
            changed_ = changed_ || !reached_[here.successors[i]];
            reached_[here.successors[i]] = true;
        }
    }

    /// Returns the conditions that hold on the edge between two blocks.
    Facts facts_on(uint32_t from, uint32_t to) const {
        Facts facts = facts_[from];
        const Block& block = function_.blocks[from];
        if (block.end == Block::End::branch && block.successors[0] != block.successors[1]) {
            const Fact fact{block.condition, to == block.successors[0]};
            facts.insert(std::ranges::lower_bound(facts, fact), fact);
        }
        return facts;
    }

    /// Returns the conditions that hold on all edges into a block, except for back edges, whose paths have
    /// passed through it.
    Facts facts_of(uint32_t block) const {
        std::optional<Facts> common;
        for (const uint32_t from : function_.blocks[block].predecessors) {
            if (from >= block || !reached_[from])
                continue;
            Facts facts = facts_on(from, block), both;
            if (common)
                std::ranges::set_intersection(*common, facts, std::back_inserter(both));
            common = common ? std::move(both) : std::move(facts);
        }
        return common.value_or(Facts{});
    }

    // ---- Values ------------------------------------------------------------------------------------------

    /// Returns the range of a value if `facts` hold.
    Interval under(Value value, const Facts& facts, int depth = 0) const {
        Interval range = values_[value];
        for (const Fact& fact : facts)
            confine(range, value, fact.condition, fact.holds);
        range.low = std::max(range.low, -k_largest_float);
        range.high = std::min(range.high, k_largest_float);
        const Instruction& instruction = function_.instructions[value];
        if (depth == 0 || !is_pure(instruction.op))
            return range;
        return intersection(range, computed(instruction, facts, depth - 1));
    }

    /// Narrows a range by one condition that holds, or does not hold.
    void confine(Interval& range, Value value, Value condition, bool holds) const {
        if (value == condition)
            range = {double(holds), double(holds)};
        const Instruction& test = function_.instructions[condition];
        const auto operands = function_.operands_of(test);
        switch (test.op) {
        case Op::logical_not: return confine(range, value, operands[0], !holds);
        case Op::logical_and:
        case Op::logical_or:
            if (holds == (test.op == Op::logical_and))
                for (const Value each : operands)
                    confine(range, value, each, holds);
            return;
        case Op::less:
        case Op::less_equal: {
            const bool strict = (test.op == Op::less) == holds;
            const Value less = operands[holds ? 0 : 1], more = operands[holds ? 1 : 0];
            if (value == less)
                confine_below(range, value, more, holds, strict);
            if (value == more)
                confine_above(range, value, less, holds, strict);
            return;
        }
        case Op::equal:
            if (holds && (value == operands[0] || value == operands[1])) {
                const Value other = value == operands[0] ? operands[1] : operands[0];
                confine_below(range, value, other, true, false);
                confine_above(range, value, other, true, false);
            }
            return;
        default: return;
        }
    }
    /// If a comparison holds, both operands are numbers; if it does not, one of them may be NaN, which gives
    /// no bound.
    void confine_below(Interval& range, Value value, Value bound, bool holds, bool strict) const {
        if (values_[bound].partial && !holds)
            return;
        range.partial = range.partial && !holds;
        const double most = values_[bound].high;
        range.high = std::max(std::min(range.high, strict ? next(value, most, -1) : most), range.low);
    }
    void confine_above(Interval& range, Value value, Value bound, bool holds, bool strict) const {
        if (values_[bound].partial && !holds)
            return;
        range.partial = range.partial && !holds;
        const double least = values_[bound].low;
        range.low = std::min(std::max(range.low, strict ? next(value, least, 1) : least), range.high);
    }
    /// Returns the next number of that value's type, up or down.
    double next(Value value, double number, int way) const {
        return function_.instructions[value].type == Scalar::real ? std::nextafter(number, way * k_infinity)
                                                                  : number + way;
    }

    static bool is_pure(Op op) {
        return op != Op::constant && op != Op::undefined && op != Op::phi && op != Op::load &&
               op != Op::store && op != Op::texel;
    }

    Interval computed(const Instruction& instruction, const Facts& facts, int depth) const {
        const auto operands = function_.operands_of(instruction);
        if (instruction.op == Op::derivative_x || instruction.op == Op::derivative_y)
            return everything(values_[operands[0]].partial);
        std::array<Interval, 3> numbers;
        const size_t count = std::min(operands.size(), numbers.size());
        for (size_t i = 0; i < count; ++i)
            numbers[i] = under(operands[i], facts, depth);
        if (instruction.op == Op::select)
            return selected(operands, numbers, facts);
        if (instruction.op == Op::narrowed) // exact in real arithmetic only
            return numbers[0];
        if (const auto kept = bits_kept(instruction, facts))
            return *kept;
        const std::span<const Interval> given(numbers.data(), count);
        const Scalar of = function_.instructions[operands[0]].type;
        const Interval range = IntervalSystem().compute(instruction.op, instruction.type, of,
                                                        {numbers[0], numbers[1], numbers[2]});
        if (instruction.type != Scalar::real || is_exact(instruction.op) ||
            std::ranges::all_of(given, &Interval::point))
            return range;
        double largest = 0;
        for (const Interval& each : given)
            largest = std::max({largest, std::abs(each.low), std::abs(each.high)});
        return in_floats(instruction.op, range, largest);
    }

    /// Matches a float whose bits are read, perhaps masked, and converted back.
    std::optional<Interval> bits_kept(const Instruction& instruction, const Facts& facts) const {
        if (instruction.op != Op::bits_as || instruction.type != Scalar::real)
            return std::nullopt;
        Value bits = function_.operands_of(instruction)[0];
        const bool masked = function_.instructions[bits].op == Op::bit_and;
        if (masked)
            bits = function_.operands_of(function_.instructions[bits])[0];
        const Instruction& taken = function_.instructions[bits];
        const Value number = taken.op == Op::bits_as ? function_.operands_of(taken)[0] : k_no_value;
        if (number == k_no_value || function_.instructions[number].type != Scalar::real)
            return std::nullopt;
        const Interval range = under(number, facts);
        const double most = std::max(-range.low, range.high); // without its sign bit it is positive
        return masked ? hull(range, {0, std::max(most, 0.0)}) : range;
    }

    /// Evaluates each side under its condition, which is what keeps a value from its undefined operands.
    Interval selected(std::span<const Value> operands, const std::array<Interval, 3>& numbers,
                      const Facts& facts) const {
        if (const auto way = IntervalSystem::decide(numbers[0]))
            return *way ? numbers[1] : numbers[2];
        const auto side = [&](size_t i) {
            Facts known = facts;
            const Fact fact{operands[0], i == 1};
            known.insert(std::ranges::lower_bound(known, fact), fact);
            return under(operands[i], known, k_depth);
        };
        return hull(side(1), side(2));
    }

    void compute(uint32_t block, Value value) {
        const Instruction& instruction = function_.instructions[value];
        const auto operands = function_.operands_of(instruction);
        switch (instruction.op) {
        case Op::undefined: return set(value, IntervalSystem::constant(0, instruction.type), {}, block);
        case Op::load: return load(value, instruction, operands);
        case Op::store: return store(block, instruction, operands);
        case Op::texel: return set(value, looked_up(instruction, operands), {}, block);
        default: return set(value, computed(instruction, facts_[block], 0), operands, block);
        }
    }

    /// A doubt about the operands `from` is passed on to the value; a new doubt has the value itself as its
    /// origin.
    void set(Value value, const Interval& range, std::span<const Value> from, uint32_t block) {
        values_[value] = range;
        origins_[value] = k_no_value;
        if (!range.partial)
            return;
        bool own = true;
        for (const Value operand : from)
            if (under(operand, facts_[block]).partial) {
                own = false;
                origins_[value] = std::min(origins_[value], origins_[operand]);
            }
        if (own)
            origins_[value] = value;
    }

    Interval looked_up(const Instruction& instruction, std::span<const Value> operands) const {
        std::vector<Interval> places;
        for (const Value operand : operands)
            places.push_back(values_[operand]);
        return textures_(function_.lookups[instruction.immediate], places);
    }

    /// Joins the ranges that a phi receives on each edge.
    void merge(uint32_t block, Value phi) {
        const Block& here = function_.blocks[block];
        const auto operands = function_.operands_of(function_.instructions[phi]);
        std::optional<Interval> all;
        Value origin = k_no_value;
        for (size_t i = 0; i < operands.size(); ++i) {
            const uint32_t from = here.predecessors[i];
            if (!reached_[from])
                continue;
            const Interval one = under(operands[i], facts_on(from, block), k_depth);
            if (one.partial)
                origin = std::min(origin, origins_[operands[i]]);
            all = all ? hull(*all, one) : one;
        }
        if (!all)
            return;
        take(values_[phi], *all, grown_[phi]);
        origins_[phi] = origin;
    }
    void take(Interval& range, const Interval& now, int& times) {
        switch (phase_) {
        case Phase::growing: return grow(range, now, times);
        case Phase::narrowing: range = now; return;
        case Phase::doubting:
            changed_ = changed_ || (now.partial && !range.partial);
            range.partial = range.partial || now.partial;
        }
    }
    /// Bounds only grow.
    void grow(Interval& range, Interval now, int& times) {
        if (times > 0)
            now = hull(range, now);
        if (times > 0 && is_same(range, now))
            return;
        range = times > k_patience ? widened_to_steps(range, now) : now;
        ++times;
        changed_ = true;
    }

    // ---- Memory: the range of everything that was ever stored in a cell -----------------------------------

    std::pair<uint32_t, uint32_t> cells(const Instruction& instruction, std::span<const Value> operands,
                                        size_t offset) const {
        const Access& access = function_.accesses[instruction.immediate];
        if (operands.size() <= offset)
            return {access.first, access.first};
        return access.cells(IntervalSystem::range(values_[operands[offset]]));
    }

    void load(Value value, const Instruction& instruction, std::span<const Value> operands) {
        const auto [low, high] = cells(instruction, operands, 0);
        Cell all = memory_[low];
        for (uint32_t i = low + 1; i <= high; ++i)
            all = {hull(all.range, memory_[i].range), std::min(all.origin, memory_[i].origin)};
        values_[value] = all.range;
        origins_[value] = all.origin;
    }

    void store(uint32_t block, const Instruction& instruction, std::span<const Value> operands) {
        const auto [low, high] = cells(instruction, operands, 1);
        const Interval what = under(operands[0], facts_[block], k_depth);
        for (uint32_t i = low; i <= high; ++i) {
            const bool narrowing = phase_ == Phase::narrowing;
            Cell& cell = (narrowing ? written_ : memory_)[i];
            take(cell.range, narrowing ? hull(cell.range, what) : what, memory_grown_[i]);
            if (what.partial)
                cell.origin = std::min(cell.origin, origins_[operands[0]]);
        }
    }

    const Function& function_;
    const Textures<Interval>& textures_;
    std::vector<Interval> values_;
    /// for each value that may be NaN or infinite: the operation that made it so
    std::vector<Value> origins_;
    std::vector<int> grown_;    ///< how often each value has grown
    std::vector<bool> reached_; ///< by block
    std::vector<Facts> facts_;
    std::vector<Cell> initial_, memory_;
    std::vector<Cell> written_; ///< in this sweep
    std::vector<int> memory_grown_;
    bool changed_ = false;
    Phase phase_ = Phase::growing;
};

} // namespace

ValueRanges value_ranges(const Function& function, const std::vector<Interval>& memory,
                         const Textures<Interval>& textures) {
    return Analysis(function, memory, textures).run();
}

} // namespace tidemark::proof
