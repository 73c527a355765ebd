#include "lab/march_rays.hpp"

#include "lab/pass_function.hpp"
#include "proof/number_systems.hpp"
#include "render/pass_state.hpp"
#include "scene/host_uniforms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace tidemark::lab {

InputRanges::InputRanges(const DrawnPass& drawn) : drawn_(&drawn) {
    const proof::Function& function = drawn.function.function();
    const auto frame = drawn.function.frame<double>(drawn.renderer, drawn.pass, drawn.inputs);
    for (size_t cell = 0; cell < function.cells.size(); ++cell) {
        const proof::Point<double>& point = frame.memory()[cell];
        const bool real = function.cells[cell] == proof::Scalar::real;
        memory_.push_back(real ? proof::IntervalSystem::number(point.real)
                               : proof::IntervalSystem::constant(point.bits, function.cells[cell]));
    }
}

void InputRanges::set(std::string_view name, std::span<const proof::Interval> ranges) {
    const proof::Variable* variable = drawn_->function.function().find(name);
    for (size_t i = 0; variable && i < std::min<size_t>(ranges.size(), variable->size); ++i)
        memory_[variable->first + i] = ranges[i];
}
void InputRanges::set(std::string_view name, const proof::Interval& range) {
    set(name, std::array{range});
}

void InputRanges::set_place(const proof::Interval& x, const proof::Interval& y) {
    set("gl_FragCoord", std::array<proof::Interval, 4>{{x, y, {0.5, 0.5}, {1, 1}}});
}

namespace {

/// Returns the value of a host uniform when iTime is that time, and so the time of every channel.
std::vector<double> value_at(scene::HostValue value, const DrawnPass& drawn, double time) {
    render::FrameInputs inputs = drawn.inputs;
    inputs.time = time;
    render::ChannelFacts channels;
    for (render::ChannelFact& channel : channels)
        channel.time = time;
    const auto numbers = render::value_of(value, inputs, drawn.renderer.extent(), channels);
    const std::span<const double> all = numbers;
    return {all.begin(), all.end()};
}

std::vector<proof::Interval> ranges_over(const proof::Interval& time, const scene::HostUniform& row,
                                         const DrawnPass& drawn) {
    const scene::RangeOverTime& over = row.over_time;
    std::vector<proof::Interval> ranges;
    switch (over.kind) {
    case scene::RangeOverTime::Kind::constant: break;
    case scene::RangeOverTime::Kind::between_ends: {
        const auto low = value_at(row.value, drawn, time.low), high = value_at(row.value, drawn, time.high);
        for (size_t i = 0; i < low.size(); ++i)
            ranges.push_back({std::min(low[i], high[i]), std::max(low[i], high[i])});
        // A channel without playback stays at 0, a file starts again, and silence is 10 s ahead of iTime.
        if (row.value == scene::HostValue::channel_time)
            for (proof::Interval& range : ranges)
                range = {std::min(0.0, range.low), std::max(0.0, range.high) + 10};
        break;
    }
    case scene::RangeOverTime::Kind::limits:
        for (size_t i = 0; i < component_count(row); ++i)
            ranges.push_back({over.low[i], over.high[i]});
    }
    return ranges;
}

/// Returns whether a variable is `iCh0` or `iChannel`: sizes and times of channels, which follow their files.
bool is_channel_struct(const proof::Variable& variable) {
    const auto names = std::span(scene::k_channel_structs);
    return variable.kind == proof::Variable::Kind::uniform &&
           (variable.name == "iChannel" || std::ranges::find(names, variable.name) != names.end());
}

} // namespace

void InputRanges::set_to_anything(const proof::Variable& variable) {
    const auto& cells = drawn_->function.function().cells;
    for (size_t i = variable.first; i < size_t(variable.first) + variable.size; ++i)
        if (cells[i] == proof::Scalar::real)
            memory_[i] = proof::everything(false);
}

void InputRanges::set_time(const proof::Interval& time) {
    const auto names = drawn_->renderer.names_of(drawn_->pass);
    for (const proof::Variable& variable : drawn_->function.function().variables) {
        const scene::HostUniform* row = variable.kind == proof::Variable::Kind::uniform
                                            ? scene::find_host_uniform(variable.name, names.other_hosts)
                                            : nullptr;
        if (is_channel_struct(variable))
            set_to_anything(variable);
        if (row && std::ranges::find(names.knobs, variable.name, &scene::Knob::name) == names.knobs.end())
            set(variable.name, ranges_over(time, *row, *drawn_));
    }
}

void InputRanges::turn_knobs() {
    for (const scene::Knob& knob : drawn_->renderer.scene().knobs) {
        if (!knob.range)
            continue;
        std::array<proof::Interval, 4> ranges;
        for (size_t i = 0; i < ranges.size(); ++i)
            ranges[i] = {knob.range->low[i], knob.range->high[i]};
        set(knob.name, ranges);
    }
}

std::optional<proof::Interval> changing(const DrawnPass& drawn, const std::string& sampler) {
    const scene::Pass& pass = drawn.renderer.scene().passes[drawn.pass];
    const auto name = std::ranges::find(scene::k_channel_names, sampler);
    const auto channel = size_t(name - scene::k_channel_names.begin());
    if (channel >= pass.channels.size())
        return std::nullopt;
    switch (scene::traits_of(pass.channels[channel].input).changes) {
    case scene::Changes::never: return std::nullopt;
    case scene::Changes::with_passes: return proof::everything(false);
    case scene::Changes::with_clock:
    case scene::Changes::with_keys: return proof::Interval{0, 1};
    }
    return std::nullopt;
}

namespace {

constexpr float k_shown_step = 1.0f / 255;

} // namespace

MarchRays::MarchRays(DrawnPass drawn)
    : drawn_(std::move(drawn)), ranges_(drawn_), textures_(textures_of(drawn_.renderer, drawn_.pass)),
      floats_(drawn_.function.frame<float>(drawn_.renderer, drawn_.pass, drawn_.inputs)),
      doubles_(drawn_.function.frame<double>(drawn_.renderer, drawn_.pass, drawn_.inputs)) {
    floats_.textures = proof::textures_in<proof::Point<float>>(textures_);
    doubles_.textures = proof::textures_in<proof::Point<double>>(textures_);
    for (const proof::MarchingLoop& loop : drawn_.function.loops()) {
        auto& step = steps_.emplace_back();
        if (loop.advance != proof::k_no_value)
            step = proof::slice_of(drawn_.function.function(), loop, proof::SliceOf::step);
    }
}

std::optional<MarchRay> MarchRays::enter(glm::ivec2 pixel, proof::Surface surface) const {
    const PassFunction& function = drawn_.function;
    proof::FloatEvaluator in_float = floats_;
    proof::PointEvaluator<double> in_double = doubles_;
    function.move_to(in_float, pixel);
    function.move_to(in_double, pixel);
    const auto index = proof::enter_first(in_float, function.loops());
    const bool both = index == proof::enter_first(in_double, function.loops());
    if (!index && both)
        return std::nullopt;
    MarchRay ray;
    if (!index || !both)
        return ray;
    ray.loop = *index;
    const proof::LoopSlice& slice = function.slices()[*index];
    const proof::FloatEvaluator entered = in_float;
    ray.march = proof::follow(in_float, function.function(), slice.loop);
    if (!proof::is_faithful(slice, entered, ray.march))
        return ray;
    ray.slice.emplace(slice, in_double, proof::textures_in<proof::Interval>(textures_), surface);
    ray.in_float.emplace(slice, entered);
    return ray;
}

/// Returns the colours that a finished run has written.
std::vector<float> MarchRays::outputs(const proof::FloatEvaluator& evaluator) const {
    std::vector<float> values;
    for (const proof::Variable& variable : drawn_.function.function().variables)
        if (variable.kind == proof::Variable::Kind::output)
            for (uint32_t i = 0; i < std::min(3u, variable.size); ++i) // without alpha
                values.push_back(evaluator.memory()[variable.first + i].real);
    return values;
}

LongerMarch MarchRays::march_longer(glm::ivec2 pixel, uint32_t most) const {
    const proof::Function& function = drawn_.function.function();
    proof::FloatEvaluator as_is = floats_;
    drawn_.function.move_to(as_is, pixel);
    const auto index = proof::enter_first(as_is, drawn_.function.loops());
    if (!index)
        return {};
    const proof::MarchingLoop& loop = drawn_.function.loops()[*index];
    proof::FloatEvaluator longer = as_is, marching = as_is;
    LongerMarch result{.hits = proof::follow_on(marching, function, loop, most).hit};
    if (!result.hits)
        return result;
    proof::Decisions none(0);
    as_is.run(
        none, [](uint32_t) { return true; }, loop.header, loop.entry);
    for (const proof::MarchingLoop::CounterTest& test : loop.counter_tests)
        longer.pin(test.comparison, {0, test.continues});
    const std::vector<bool> inside = proof::natural_loop(function, loop.header);
    uint32_t iterations = 0;
    longer.run(
        none,
        [&](uint32_t block) {
            iterations += block == loop.latch;
            if (!inside[block] || iterations == most)
                longer.unpin();
            return true;
        },
        loop.header, loop.entry);
    const std::vector<float> before = outputs(as_is), after = outputs(longer);
    for (size_t i = 0; i < before.size(); ++i)
        result.shows |=
            !(std::abs(std::clamp(after[i], 0.0f, 1.0f) - std::clamp(before[i], 0.0f, 1.0f)) <= k_shown_step);
    return result;
}

proof::Textures<proof::Interval> MarchRays::textures_of_all(bool at_any_time) const {
    return [this, at_any_time](const proof::Lookup& lookup, std::span<const proof::Interval> operands) {
        const auto any = at_any_time ? changing(drawn_, lookup.sampler) : std::nullopt;
        return any ? *any : proof::look_up(textures_, lookup, operands, proof::UnnamedLevel::any);
    };
}

std::optional<AreaRays> MarchRays::enter_all(const RayArea& area, proof::SliceOf what,
                                             proof::Surface surface) const {
    InputRanges ranges = ranges_;
    ranges.set_place(area.x, area.y);
    if (area.time)
        ranges.set_time(*area.time);
    proof::Evaluator<proof::IntervalSystem> all(drawn_.function.function());
    all.memory() = ranges.memory();
    all.textures = textures_of_all(area.time.has_value());
    const auto index = proof::enter_first(all, drawn_.function.loops());
    if (!index || (what == proof::SliceOf::step && !steps_[*index]))
        return std::nullopt;
    const proof::LoopSlice& slice =
        what == proof::SliceOf::step ? *steps_[*index] : drawn_.function.slices()[*index];
    return AreaRays{*index, proof::MarchSlice(slice, all, all.textures, surface)};
}

proof::ValueRanges ranges_of(const DrawnPass& drawn, double seconds) {
    InputRanges inputs(drawn);
    const auto [width, height] = drawn.renderer.extent();
    inputs.set_place({0.5, width - 0.5}, {0.5, height - 0.5});
    inputs.set_time({0, seconds});
    inputs.turn_knobs();
    const proof::TextureSet textures = textures_of(drawn.renderer, drawn.pass);
    return proof::value_ranges(
        drawn.function.function(), inputs.memory(),
        [&](const proof::Lookup& lookup, std::span<const proof::Interval> operands) {
            const auto any = changing(drawn, lookup.sampler);
            return any ? *any : proof::look_up(textures, lookup, operands, proof::UnnamedLevel::any);
        });
}

namespace {

constexpr Extent k_areas{16, 9};
/// Length of the pieces: the first is this share of the ray's length, the others are this share of the way so
/// far. They grow with the area's width.
constexpr double k_first_piece = 1.0 / 128;
constexpr double k_longer = 0.1;
/// A piece without a bound is cut into this many.
constexpr int k_cuts = 4;
/// Steeper bounds do not limit steps.
constexpr double k_steepest = 100;

class AreaLook {
public:
    AreaLook(proof::MarchSlice& slice, double end, AreaSlopes& slopes)
        : slice_(slice), end_(end), unit_(slice.unit()), slopes_(slopes) {}

    void run() {
        const double start = slice_.start(), first = (end_ - start) * k_first_piece;
        for (double at = start; at < end_;) {
            const double high = std::min(at + std::max(first, k_longer * (at - start)), end_);
            if (!look_at({at, high}, k_cuts))
                return;
            at = high;
        }
    }

private:
    /// Adds the bounds of a piece. Returns whether the space before the surface continues after it.
    bool look_at(const proof::Interval& piece, int cuts) {
        const auto tangent = slice_.tangent(piece);
        if (tangent && !(tangent->value.high > 0))
            return false;
        const auto beside = tangent ? std::optional(tangent->slope) : slice_.slope_beside_jumps(piece);
        if (beside && -beside->low <= k_steepest * unit_) {
            const double way = piece.width() * unit_;
            slopes_.bounded.push_back({std::max(0.0, -beside->low / unit_), way});
            slopes_.may_jump += tangent ? 0 : way;
            return true;
        }
        if (cuts == 1) {
            const auto distance = slice_.distance(piece, proof::Care::quick);
            if (distance && !distance->partial && !(distance->high > 0))
                return false;
            (distance && distance->partial ? slopes_.not_finite : slopes_.unbounded) += piece.width() * unit_;
            return true;
        }
        bool more = true;
        for (int i = 0; i < cuts && more; ++i)
            more = look_at({piece.low + piece.width() * i / cuts, piece.low + piece.width() * (i + 1) / cuts},
                           1);
        return more;
    }

    proof::MarchSlice& slice_;
    double end_;
    double unit_;
    AreaSlopes& slopes_;
};

} // namespace

double AreaSlopes::bounded_way() const {
    double sum = 0;
    for (const Bound& each : bounded)
        sum += each.way;
    return sum;
}

double AreaSlopes::falls_on(double part) const {
    std::vector<Bound> sorted = bounded;
    std::ranges::sort(sorted, {}, &Bound::falls);
    double left = part * bounded_way();
    for (const Bound& each : sorted)
        if ((left -= each.way) <= 0)
            return each.falls;
    return sorted.empty() ? 0 : sorted.back().falls;
}

void AreaSlopes::add(const AreaSlopes& more) {
    bounded.insert(bounded.end(), more.bounded.begin(), more.bounded.end());
    may_jump += more.may_jump;
    unbounded += more.unbounded;
    not_finite += more.not_finite;
}

AreaSlopes area_slopes(const MarchRays& rays, uint64_t most_evaluations) {
    AreaSlopes slopes;
    const Extent whole = rays.extent();
    const double width = double(whole.width) / k_areas.width, height = double(whole.height) / k_areas.height;
    uint64_t left = most_evaluations;
    for (int y = 0; y < k_areas.height; ++y)
        for (int x = 0; x < k_areas.width; ++x) {
            const auto one =
                rays.enter({int((x + 0.5) * width), int((y + 0.5) * height)}, proof::Surface::zero);
            if (!one || !one->slice || one->march.turns.empty() || left == 0 ||
                !(one->march.hit || one->march.far))
                continue;
            auto all = rays.enter_all({{x * width, (x + 1) * width}, {y * height, (y + 1) * height}},
                                      proof::SliceOf::distance, proof::Surface::zero);
            const double end = one->slice->end(one->march);
            const double way = (end - one->slice->start()) * one->slice->unit();
            if (!std::isfinite(way) || !(way > 0))
                continue;
            if (!all || all->loop != one->loop) { // the code before the march may differ
                slopes.unbounded += way;
                continue;
            }
            AreaLook(all->slice, end, slopes).run();
            left -= std::min(left, all->slice.evaluations());
        }
    return slopes;
}

} // namespace tidemark::lab
