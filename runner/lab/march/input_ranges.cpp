#include "lab/march/input_ranges.hpp"

#include "ir/interval_system.hpp"
#include "scene/host_uniforms.hpp"

#include <algorithm>
#include <array>

namespace tidemark::lab {

InputRanges::InputRanges(const DrawnPass& drawn) : drawn_(&drawn) {
    const ir::Function& function = drawn.function.function();
    const auto frame = drawn.function.frame<double>(drawn.renderer, drawn.pass, drawn.inputs);
    for (size_t cell = 0; cell < function.cells.size(); ++cell) {
        const ir::Point<double>& point = frame.memory()[cell];
        const bool real = function.cells[cell] == ir::Scalar::real;
        memory_.push_back(real ? ir::IntervalSystem::number(point.real)
                               : ir::IntervalSystem::constant(point.bits, function.cells[cell]));
    }
}

void InputRanges::set(std::string_view name, std::span<const ir::Interval> ranges) {
    const ir::Variable* variable = drawn_->function.function().find(name);
    for (size_t i = 0; variable && i < std::min<size_t>(ranges.size(), variable->size); ++i)
        memory_[variable->first + i] = ranges[i];
}
void InputRanges::set(std::string_view name, const ir::Interval& range) {
    set(name, std::array{range});
}

void InputRanges::set_place(const ir::Interval& x, const ir::Interval& y) {
    set("gl_FragCoord", std::array<ir::Interval, 4>{{x, y, {0.5, 0.5}, {1, 1}}});
}

void InputRanges::set_time(const ir::Interval& time) {
    constexpr double k_frames_a_second = 1000;
    set("iTime", time);
    set(scene::k_time_low_uniform, {-1, 1});
    set("iFrame", {0, std::min(time.high * k_frames_a_second, 2147483647.0)});
    set("iTimeDelta", {0, 1});
    set("iFrameRate", {0, k_frames_a_second});
    set("iChannelTime", std::array{time, time, time, time});
    set("iDate", std::array<ir::Interval, 4>{{{0, 9999}, {0, 11}, {1, 31}, {0, 86400}}});
}

void InputRanges::turn_knobs() {
    for (const scene::Knob& knob : drawn_->renderer.scene().knobs) {
        if (!knob.range)
            continue;
        std::array<ir::Interval, 4> ranges;
        for (size_t i = 0; i < ranges.size(); ++i)
            ranges[i] = {knob.range->low[i], knob.range->high[i]};
        set(knob.name, ranges);
    }
}

std::optional<ir::Interval> changing(const DrawnPass& drawn, const std::string& sampler) {
    const scene::Pass& pass = drawn.renderer.scene().passes[drawn.pass];
    const auto name = std::ranges::find(scene::k_channel_names, sampler);
    const auto channel = size_t(name - scene::k_channel_names.begin());
    if (channel >= pass.channels.size())
        return std::nullopt;
    switch (scene::traits_of(pass.channels[channel].input).changes) {
    case scene::Changes::never: return std::nullopt;
    case scene::Changes::with_passes: return ir::everything(false);
    case scene::Changes::with_clock:
    case scene::Changes::with_keys: return ir::Interval{0, 1};
    }
    return std::nullopt;
}

} // namespace tidemark::lab
