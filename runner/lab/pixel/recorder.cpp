#include "lab/pixel/recorder.hpp"

#include "ir/dependence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tidemark::lab {
namespace {

using ir::Assignment;
using ir::Block;
using ir::Instruction;
using ir::Lockstep;
using ir::LockstepEvaluator;
using ir::Op;
using ir::Scalar;
using Kind = TracedValue::Kind;

/// Half a unit in the last place of a float.
constexpr double k_least_spread = 0x1p-24;

Kind kind_of(Scalar type) {
    return type == Scalar::real ? Kind::real : type == Scalar::boolean ? Kind::condition : Kind::whole;
}

template <class Real>
double number(const ir::Point<Real>& point, Scalar type) {
    if (type == Scalar::real)
        return point.real;
    return type == Scalar::signed_int ? double(int32_t(point.bits)) : double(point.bits);
}

double spread_of(const LockstepEvaluator& evaluator, const std::vector<ir::Value>& values) {
    std::vector<ir::Samples> components;
    for (const ir::Value value : values)
        components.push_back(evaluator.value(value).samples);
    return ir::relative_spread(components);
}

/// Returns the name; for an array element with its index, which may be computed.
std::string name_of(const LockstepEvaluator& evaluator, const Assignment& each) {
    if (each.kind != Assignment::Kind::stored)
        return each.name;
    const uint32_t offset =
        each.offset == ir::k_no_value ? 0 : evaluator.value(each.offset).in_float.bits / each.stride;
    return fmt::format("{}[{}]", each.name, each.first_element + offset);
}

TracedValue value_of(const LockstepEvaluator& evaluator, const ir::Function& function,
                     const Assignment& each) {
    const Scalar type = function.instructions[each.values.front()].type;
    TracedValue result;
    result.kind = kind_of(type);
    result.name = name_of(evaluator, each);
    result.carried = each.kind == Assignment::Kind::carried;
    result.rows = each.rows;
    for (const ir::Value value : each.values) {
        const Lockstep& all = evaluator.value(value);
        result.in_float.push_back(number(all.in_float, type));
        result.in_double.push_back(number(all.in_double, type));
        result.unstable = result.unstable || (type != Scalar::real && all.rounding_decides());
    }
    result.digits = type == Scalar::real ? ir::significant_digits(spread_of(evaluator, each.values))
                    : result.unstable    ? 0
                                         : ir::k_most_digits;
    return result;
}

/// Returns whether the operation computes a float from floats with rounding.
bool is_rounded(Op op) {
    return op != Op::phi && op != Op::load && op != Op::store && op != Op::select && op != Op::texel;
}

} // namespace

Recorder::Recorder(const ir::Function& function, const PassLines& lines, std::optional<int> line,
                   std::optional<TurnRange> turns)
    : function_(&function), source_(&lines), wanted_(line), range_(std::move(turns)),
      around_(function.blocks.size()), spreads_(function.instructions.size()) {
    for (uint32_t block = 0; block < function.blocks.size(); ++block)
        if (function.blocks[block].loop)
            if (auto text = ir::text_of_loop(function, block); !text.empty())
                loops_.push_back({block, std::move(text)});
    for (uint32_t loop = 0; loop < loops_.size(); ++loop)
        for (uint32_t block = 0; block < around_.size(); ++block)
            if (loops_[loop].blocks[block])
                around_[block].push_back(loop);
}

void Recorder::record(const LockstepEvaluator& evaluator, uint32_t block) {
    count_turns(block);
    measure_losses(evaluator, block);
    compare_conditions(evaluator, block);
    for (const Assignment& each : source_->in_block(block))
        take(evaluator, each);
}

void Recorder::count_turns(uint32_t block) {
    for (const uint32_t index : around_[block])
        if (Loop& loop = loops_[index]; loop.header == block)
            loop.turn = previous_ && loop.blocks[*previous_] ? loop.turn + 1 : 1;
    previous_ = block;
}

Turns Recorder::turns(uint32_t block) const {
    Turns result;
    for (const uint32_t loop : around_[block])
        result.push_back(loops_[loop].turn);
    return result;
}

Recorder::Line* Recorder::line(int number) {
    const auto known = lines_.find(number);
    if (known != lines_.end())
        return &known->second;
    const AuthorLine* author = source_->find(number);
    if (!author)
        return nullptr;
    Line& made = lines_[number];
    made.traced.line = *author;
    return &made;
}

double Recorder::widening(const Instruction& instruction, double spread) const {
    if (!is_rounded(instruction.op))
        return 1;
    double before = k_least_spread;
    for (const ir::Value operand : function_->operands_of(instruction))
        if (function_->instructions[operand].type == Scalar::real)
            before = std::max(before, spreads_[operand]);
    return std::min(spread, 1.0) / std::min(before, 1.0);
}

void Recorder::measure_losses(const LockstepEvaluator& evaluator, uint32_t block) {
    const Block& here = function_->blocks[block];
    for (ir::Value value = here.first; value < here.last; ++value) {
        const Instruction& instruction = function_->instructions[value];
        if (instruction.type != Scalar::real || instruction.op == Op::store)
            continue;
        spreads_[value] = ir::relative_spread({&evaluator.value(value).samples, 1});
        const double factor = widening(instruction, spreads_[value]);
        if (factor <= 1 || !std::isfinite(evaluator.value(value).in_float.real))
            continue;
        Line* on = line(instruction.line);
        if (on && factor > on->largest_loss) {
            on->largest_loss = factor;
            on->traced.lost = std::log10(factor);
            on->traced.lost_turns = turns(block);
        }
    }
}

void Recorder::compare_conditions(const LockstepEvaluator& evaluator, uint32_t block) {
    const Block& here = function_->blocks[block];
    for (ir::Value value = here.first; value < here.last; ++value)
        if (const Instruction& each = function_->instructions[value]; each.op == Op::select)
            compare(evaluator.value(function_->operands_of(each)[0]), each.line, block);
    if (here.condition != ir::k_no_value)
        compare(evaluator.value(here.condition), here.line, block);
}

void Recorder::compare(const Lockstep& condition, int number, uint32_t block) {
    const bool parts = condition.double_differs(), unstable = condition.rounding_decides();
    if (!parts && !unstable)
        return;
    Line* on = line(number);
    if (!on)
        return;
    const auto note = [&](Occurrence& what) {
        if (what.times++ == 0)
            what.first = turns(block);
        return what.times == 1;
    };
    if (parts && note(on->traced.mismatch))
        on->traced.float_holds = condition.in_float.bits != 0;
    if (unstable)
        note(on->traced.unstable);
}

void Recorder::take(const LockstepEvaluator& evaluator, const Assignment& each) {
    Line* on = line(each.line);
    ++order_;
    ++on->traced.values;
    const bool real = function_->instructions[each.values.front()].type == Scalar::real;
    const double spread = real ? spread_of(evaluator, each.values) : 0;
    const bool finite = std::ranges::all_of(
        each.values, [&](ir::Value value) { return std::isfinite(evaluator.value(value).in_float.real); });
    const bool worse = finite && spread > on->worst;
    const bool first_not_finite = !finite && !on->traced.not_finite;
    if (!worse && !first_not_finite && each.line != wanted_)
        return;
    TracedValue value = value_of(evaluator, *function_, each);
    value.turns = turns(each.block);
    value.order = order_;
    if (worse) {
        on->worst = spread;
        on->traced.digits = value.digits;
        on->traced.fewest = value.name;
        on->traced.fewest_turns = value.turns;
    }
    if (first_not_finite)
        on->traced.not_finite = value;
    if (each.line == wanted_)
        kept_[&each].add(std::move(value), range_);
}

std::vector<TracedLine> Recorder::lines() const {
    std::vector<TracedLine> result;
    for (const auto& [number, line] : lines_)
        result.push_back(line.traced);
    return result;
}

LineInCall Recorder::call(uint32_t index, const PassFunction& function) const {
    LineInCall result;
    const auto& all = function_->names.calls;
    if (index < all.size())
        result.function = all[index].function;
    for (; index < all.size() && all[index].line > 0; index = all[index].caller)
        if (SourceLocation where = function.locate(all[index].line); !where.file.empty())
            result.callers.push_back(std::move(where));
    return result;
}

/// Values of calls at the same place of the text are merged.
std::vector<LineInCall> Recorder::calls(const PassFunction& function) const {
    std::vector<LineInCall> result;
    for (const auto& [assignment, kept] : kept_) {
        LineInCall here = call(assignment->call, function);
        const auto same = std::ranges::find(result, here.callers, &LineInCall::callers);
        auto& values = same == result.end() ? result.emplace_back(std::move(here)).values : same->values;
        std::ranges::move(kept.all(), std::back_inserter(values));
    }
    std::erase_if(result, [](const LineInCall& line) { return line.values.empty(); });
    for (LineInCall& line : result)
        std::ranges::sort(line.values, {}, &TracedValue::order);
    std::ranges::sort(result, {}, [](const LineInCall& line) { return line.values.front().order; });
    return result;
}

} // namespace tidemark::lab
