// Keeps a bounded selection of the values computed at one place of a text: the first and last few, and those
// with an event; or those of the requested iterations.

#include "lab/pixel_trace.hpp"

#include "base/error.hpp"
#include "lab/pass_function.hpp"
#include "lab/pass_lines.hpp"
#include "proof/loops.hpp"
#include "proof/number_systems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <utility>
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

// Records a pixel's values while it is evaluated, line by line, in bounded memory: for a long loop the first
// and last few iterations, and those with an event.

class Recorder {
public:
    /// Keeps only the values of `line`, a line of the compiled text.
    Recorder(const proof::Function& function, const PassLines& lines, std::optional<int> line,
             std::optional<TurnRange> turns);

    /// Call it after each executed block.
    void record(const proof::LockstepEvaluator& evaluator, uint32_t block);

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
        double worst = 0;        ///< largest relative spread of a value
        double largest_loss = 1; ///< largest factor by which an operation widened the spread
    };

    void count_turns(uint32_t block);
    Turns turns(uint32_t block) const;
    void measure_losses(const proof::LockstepEvaluator& evaluator, uint32_t block);
    void measure_dropped(const proof::LockstepEvaluator& evaluator, proof::Value value);
    double widening(const proof::Instruction& instruction, double spread) const;
    void compare_conditions(const proof::LockstepEvaluator& evaluator, uint32_t block);
    void compare(const proof::Lockstep& condition, int line, uint32_t block);
    void take(const proof::LockstepEvaluator& evaluator, const proof::Assignment& each);
    Line* line(int number);
    LineInCall call(uint32_t index, const PassFunction& function) const;

    const proof::Function* function_;
    const PassLines* source_;
    std::optional<int> wanted_;
    std::optional<TurnRange> range_;
    std::vector<Loop> loops_;                   ///< outer loops first
    std::vector<std::vector<uint32_t>> around_; ///< for each block: the loops around it
    std::optional<uint32_t> previous_;          ///< the previous block
    std::vector<double> spreads_;               ///< relative spread of each instruction's result
    std::map<int, Line> lines_;
    std::map<const proof::Assignment*, KeptValues> kept_;
    uint64_t order_ = 0;
};

namespace {

constexpr size_t k_first = 4, k_last = 3;
/// Limit if iterations were requested.
constexpr size_t k_most_values = 1000;

} // namespace

bool TracedValue::finite() const {
    return std::ranges::all_of(in_float, [](double each) { return std::isfinite(each); });
}

bool TracedValue::mismatch() const {
    return kind != Kind::real && in_float != in_double;
}

void KeptValues::add(TracedValue value, const std::optional<TurnRange>& turns) {
    value.number = ++count_;
    if (turns) {
        const bool asked =
            !value.turns.empty() && value.turns.back() >= turns->first && value.turns.back() <= turns->second;
        if (asked && first_.size() < k_most_values)
            first_.push_back(std::move(value));
        return;
    }
    const auto note = [&](std::optional<TracedValue>& event, bool happens) {
        if (!event && happens)
            event = value;
    };
    note(not_finite_, !value.finite());
    note(mismatch_, value.mismatch());
    note(unstable_, value.unstable);
    if (!fewest_ || value.digits < fewest_->digits)
        fewest_ = value;
    if (first_.size() < k_first) {
        first_.push_back(std::move(value));
        return;
    }
    last_.push_back(std::move(value));
    if (last_.size() > k_last)
        last_.pop_front();
}

std::vector<TracedValue> KeptValues::all() const {
    std::map<uint64_t, TracedValue> by_number;
    for (const TracedValue& each : first_)
        by_number.emplace(each.number, each);
    for (const TracedValue& each : last_)
        by_number.emplace(each.number, each);
    for (const auto* event : {&not_finite_, &mismatch_, &unstable_, &fewest_})
        if (*event)
            by_number.emplace((*event)->number, **event);
    std::vector<TracedValue> result;
    for (auto& [number, value] : by_number)
        result.push_back(std::move(value));
    return result;
}

namespace {

using proof::Assignment;
using proof::Block;
using proof::Instruction;
using proof::Lockstep;
using proof::LockstepEvaluator;
using proof::Op;
using proof::Scalar;
using ValueKind = TracedValue::Kind;

/// Half a unit in the last place of a float.
constexpr double k_least_spread = 0x1p-24;

ValueKind kind_of(Scalar type) {
    return type == Scalar::real      ? ValueKind::real
           : type == Scalar::boolean ? ValueKind::condition
                                     : ValueKind::whole;
}

template <class Real>
double value_number(const proof::Point<Real>& point, Scalar type) {
    if (type == Scalar::real)
        return point.real;
    return type == Scalar::signed_int ? double(int32_t(point.bits)) : double(point.bits);
}

double spread_of(const LockstepEvaluator& evaluator, const std::vector<proof::Value>& values) {
    std::vector<proof::Samples> components;
    for (const proof::Value value : values)
        components.push_back(evaluator.value(value).samples);
    return proof::relative_spread(components);
}

/// Returns the name; for an array element with its index, which may be computed.
std::string name_of(const LockstepEvaluator& evaluator, const Assignment& each) {
    if (each.kind != Assignment::Kind::stored)
        return each.name;
    const uint32_t offset =
        each.offset == proof::k_no_value ? 0 : evaluator.value(each.offset).in_float.bits / each.stride;
    return fmt::format("{}[{}]", each.name, each.first_element + offset);
}

TracedValue traced_value_of(const LockstepEvaluator& evaluator, const proof::Function& function,
                            const Assignment& each) {
    const Scalar type = function.instructions[each.values.front()].type;
    TracedValue result;
    result.kind = kind_of(type);
    result.name = name_of(evaluator, each);
    result.carried = each.kind == Assignment::Kind::carried;
    result.rows = each.rows;
    for (const proof::Value value : each.values) {
        const Lockstep& all = evaluator.value(value);
        result.in_float.push_back(value_number(all.in_float, type));
        result.in_double.push_back(value_number(all.in_double, type));
        result.unstable = result.unstable || (type != Scalar::real && all.rounding_decides());
    }
    result.digits = type == Scalar::real ? proof::significant_digits(spread_of(evaluator, each.values))
                    : result.unstable    ? 0
                                         : proof::k_most_digits;
    return result;
}

/// Returns whether the operation computes a float from floats with rounding.
bool is_rounded(Op op) {
    return op != Op::phi && op != Op::load && op != Op::store && op != Op::select && op != Op::texel;
}

} // namespace

Recorder::Recorder(const proof::Function& function, const PassLines& lines, std::optional<int> line,
                   std::optional<TurnRange> turns)
    : function_(&function), source_(&lines), wanted_(line), range_(std::move(turns)),
      around_(function.blocks.size()), spreads_(function.instructions.size()) {
    for (uint32_t block = 0; block < function.blocks.size(); ++block)
        if (function.blocks[block].loop)
            if (auto text = proof::text_of_loop(function, block); !text.empty())
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
    for (const proof::Value operand : function_->operands_of(instruction))
        if (function_->instructions[operand].type == Scalar::real)
            before = std::max(before, spreads_[operand]);
    return std::min(spread, 1.0) / std::min(before, 1.0);
}

void Recorder::measure_losses(const LockstepEvaluator& evaluator, uint32_t block) {
    const Block& here = function_->blocks[block];
    for (proof::Value value = here.first; value < here.last; ++value) {
        const Instruction& instruction = function_->instructions[value];
        if (instruction.type != Scalar::real || instruction.op == Op::store)
            continue;
        spreads_[value] = proof::relative_spread({&evaluator.value(value).samples, 1});
        measure_dropped(evaluator, value);
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

/// A sum keeps of its smaller operand only what is above half a unit in the last place of its result.
void Recorder::measure_dropped(const LockstepEvaluator& evaluator, proof::Value value) {
    const Instruction& instruction = function_->instructions[value];
    if (instruction.op != Op::add && instruction.op != Op::subtract)
        return;
    const double sum = std::abs(evaluator.value(value).in_float.real);
    double least = sum;
    for (const proof::Value operand : function_->operands_of(instruction)) {
        const double size = std::abs(evaluator.value(operand).in_float.real);
        if (function_->instructions[operand].op != Op::constant && size > 0)
            least = std::min(least, size);
    }
    const double dropped = sum > 0 && std::isfinite(sum) ? std::log10(sum / least) : 0;
    if (Line* on = dropped > 0 ? line(instruction.line) : nullptr)
        on->traced.dropped = std::max(on->traced.dropped, std::min(dropped, proof::k_most_digits));
}

void Recorder::compare_conditions(const LockstepEvaluator& evaluator, uint32_t block) {
    const Block& here = function_->blocks[block];
    for (proof::Value value = here.first; value < here.last; ++value)
        if (const Instruction& each = function_->instructions[value]; each.op == Op::select)
            compare(evaluator.value(function_->operands_of(each)[0]), each.line, block);
    if (here.condition != proof::k_no_value)
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
        each.values, [&](proof::Value value) { return std::isfinite(evaluator.value(value).in_float.real); });
    const bool worse = finite && spread > on->worst;
    const bool first_not_finite = !finite && !on->traced.not_finite;
    if (!worse && !first_not_finite && each.line != wanted_)
        return;
    TracedValue value = traced_value_of(evaluator, *function_, each);
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

namespace {

using proof::Ended;
using proof::Op;

/// Takes about five seconds.
constexpr uint64_t k_most_operations = 50'000'000;

/// Returns an evaluator of all three numbers, with the uniforms and the place of `pixel`.
proof::LockstepEvaluator in_lockstep(const proof::Function& function, const proof::FloatEvaluator& pixel,
                                     uint64_t seed) {
    proof::LockstepEvaluator evaluator(function, proof::LockstepSystem(seed));
    for (size_t cell = 0; cell < pixel.memory().size(); ++cell)
        evaluator.memory()[cell] = proof::LockstepSystem::exactly(pixel.memory()[cell]);
    evaluator.most_steps = k_most_operations;
    return evaluator;
}

/// Looks up each of the three numbers at its own place; sets `base_level` if the device would choose a mipmap
/// level.
proof::Textures<proof::Lockstep> looked_up(const proof::TextureSet& textures, bool& base_level) {
    return [&](const proof::Lookup& lookup, std::span<const proof::Lockstep> operands) {
        const auto texels = textures.find(lookup.sampler);
        base_level = base_level || (texels != textures.end() && texels->second->chooses_level(lookup));
        const auto at = [&]<class Real>(auto member) {
            std::vector<proof::Point<Real>> places;
            for (const proof::Lockstep& operand : operands)
                places.push_back(member(operand));
            return proof::look_up(textures, lookup, std::span<const proof::Point<Real>>(places));
        };
        proof::Lockstep found{at.operator()<float>([](const auto& each) { return each.in_float; }),
                              at.operator()<double>([](const auto& each) { return each.in_double; }),
                              {}};
        for (size_t i = 0; i < found.samples.size(); ++i)
            found.samples[i] = at.operator()<float>([i](const auto& each) { return each.samples[i]; });
        return found;
    };
}

bool is_unknown(const proof::Function& function, const proof::Instruction& instruction,
                const proof::TextureSet& textures) {
    if (instruction.op != Op::texel)
        return instruction.op == Op::derivative_x || instruction.op == Op::derivative_y;
    const proof::Lookup& lookup = function.lookups[instruction.immediate];
    return !textures.contains(lookup.sampler) || lookup.form == proof::Lookup::Form::gather ||
           lookup.form == proof::Lookup::Form::query;
}

/// Returns, for each block, the first instruction whose value the evaluator cannot compute.
std::vector<proof::Value> unknown_values(const proof::Function& function, const proof::TextureSet& textures) {
    std::vector<proof::Value> result(function.blocks.size(), proof::k_no_value);
    for (size_t block = 0; block < result.size(); ++block)
        for (proof::Value i = function.blocks[block].last; i-- > function.blocks[block].first;)
            if (is_unknown(function, function.instructions[i], textures))
                result[block] = i;
    return result;
}

Error not_followed(const PassFunction& function, proof::Value value) {
    const proof::Instruction& instruction = function.function().instructions[value];
    return error_at(function.locate(instruction.line),
                    instruction.op == Op::texel
                        ? "cannot evaluate this texture read: the texture is of the previous frame or too "
                          "large, or the read is textureGather or textureQueryLod"
                        : "cannot evaluate this derivative: neighbouring pixels are not evaluated");
}

void read_colour(const proof::LockstepEvaluator& evaluator, const proof::Function& function,
                 PixelTrace& trace) {
    const auto output =
        std::ranges::find(function.variables, proof::Variable::Kind::output, &proof::Variable::kind);
    if (output == function.variables.end())
        return;
    for (uint32_t i = 0; i < std::min<size_t>(output->size, trace.in_float.size()); ++i) {
        const proof::Lockstep& component = evaluator.memory()[output->first + i];
        trace.in_float[i] = component.in_float.real;
        trace.in_double[i] = component.in_double.real;
        trace.digits[i] = proof::significant_digits({&component.samples, 1});
    }
}

Colour colour_at(const image::Image& image, glm::ivec2 pixel) {
    Colour colour{};
    const size_t first = (size_t(pixel.y) * size_t(image.extent.width) + size_t(pixel.x)) * colour.size();
    for (size_t i = 0; i < colour.size(); ++i)
        colour[i] = double(image.f32()[first + i]);
    return colour;
}

PixelTrace::End end_of(Ended ended) {
    switch (ended) {
    case Ended::left: return PixelTrace::End::complete;
    case Ended::discarded: return PixelTrace::End::discarded;
    default: return PixelTrace::End::too_long;
    }
}

Result<PixelTrace> follow(const PassFunction& function, const PassLines& lines,
                          const proof::FloatEvaluator& pixel, const proof::TextureSet& textures,
                          const PixelRequest& request) {
    std::optional<int> line;
    if (request.line)
        line = TRY(lines.compiled_line(*request.line));
    proof::LockstepEvaluator evaluator = in_lockstep(function.function(), pixel, request.seed);
    Recorder recorder(function.function(), lines, line, request.turns);
    PixelTrace trace;
    if (line)
        trace.asked = *lines.find(*line);
    evaluator.textures = looked_up(textures, trace.at_base_level);
    const std::vector<proof::Value> unknown = unknown_values(function.function(), textures);
    proof::Value found = proof::k_no_value;
    proof::Decisions decisions(0);
    const Ended ended = evaluator.run(decisions, [&](uint32_t block) {
        const proof::Block& here = function.function().blocks[block];
        trace.operations += here.last - here.first;
        found = unknown[block];
        recorder.record(evaluator, block);
        return found == proof::k_no_value;
    });
    if (found != proof::k_no_value)
        return fail(not_followed(function, found));
    trace.end = end_of(ended);
    read_colour(evaluator, function.function(), trace);
    trace.lines = recorder.lines();
    trace.calls = recorder.calls(function);
    return trace;
}

} // namespace

Result<PixelTrace> trace_pixel(const render::Renderer& renderer, const render::FrameInputs& inputs,
                               const PixelRequest& request) {
    const scene::Pass& pass = renderer.shown_pass();
    if (pass.kind != scene::PassKind::image && pass.kind != scene::PassKind::buffer)
        return fail(ErrorCode::usage,
                    fmt::format("--pass \"{}\": only pixels of Image and of buffers are traced", pass.name));
    const auto function = TRY(PassFunction::create(renderer.scene(), pass, proof::Names::keep));
    proof::FloatEvaluator pixel = function.frame(renderer, renderer.shown_index(), inputs);
    function.move_to(pixel, request.pixel);
    auto trace = TRY(follow(function, PassLines(function, renderer.scene(), pass), pixel,
                            textures_of(renderer, renderer.shown_index()), request));
    trace.on_device = colour_at(renderer.read_floats(renderer.shown_index()), request.pixel);
    return trace;
}

const TracedLine* most_lossy(const PixelTrace& trace) {
    constexpr double k_least = 2;
    const auto most = std::ranges::max_element(trace.lines, {}, &TracedLine::lost);
    if (most != trace.lines.end() && most->lost >= k_least)
        return &*most;
    constexpr double k_most_dropped = 4;
    const auto dropping = std::ranges::max_element(trace.lines, {}, &TracedLine::dropped);
    return dropping != trace.lines.end() && dropping->dropped >= k_most_dropped ? &*dropping : nullptr;
}

bool is_as_drawn(const PixelTrace& trace) {
    constexpr double k_margin = 10; // functions of a device round worse than its operations
    for (size_t i = 0; i < trace.in_float.size(); ++i) {
        const double cpu = trace.in_float[i], device = trace.on_device[i];
        const bool same = cpu == device || (std::isnan(cpu) && std::isnan(device));
        const double expected = k_margin * std::pow(10, -trace.digits[i]) * std::max(std::abs(cpu), 0.1);
        if (!same && !(std::abs(cpu - device) <= expected))
            return false;
    }
    return true;
}

} // namespace tidemark::lab
