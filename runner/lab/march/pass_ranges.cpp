#include "lab/march/pass_ranges.hpp"

#include "ir/interval_system.hpp"
#include "lab/march/pass_textures.hpp"
#include "scene/host_uniforms.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace tidemark::lab {
namespace {

using ir::Interval;

/// Cells of the memory as a set of numbers each.
class Inputs {
public:
    explicit Inputs(const DrawnPass& drawn) : function_(drawn.function.function()) {
        const auto frame = drawn.function.frame<double>(drawn.renderer, drawn.pass, drawn.inputs);
        for (size_t cell = 0; cell < function_.cells.size(); ++cell) {
            const ir::Point<double>& point = frame.memory()[cell];
            const bool real = function_.cells[cell] == ir::Scalar::real;
            memory_.push_back(real ? ir::IntervalSystem::number(point.real)
                                   : ir::IntervalSystem::constant(point.bits, function_.cells[cell]));
        }
    }

    /// Where the pass reads it.
    void set(std::string_view name, std::span<const Interval> ranges) {
        const ir::Variable* variable = function_.find(name);
        for (size_t i = 0; variable && i < std::min<size_t>(ranges.size(), variable->size); ++i)
            memory_[variable->first + i] = ranges[i];
    }
    void set(std::string_view name, const Interval& range) { set(name, std::array{range}); }

    const std::vector<Interval>& memory() const { return memory_; }

private:
    const ir::Function& function_;
    std::vector<Interval> memory_;
};

void let_time_pass(Inputs& inputs, double seconds) {
    constexpr double k_frames_a_second = 1000;
    const Interval time{0, seconds};
    inputs.set("iTime", time);
    inputs.set(scene::k_time_low_uniform, {-1, 1});
    inputs.set("iFrame", {0, std::min(seconds * k_frames_a_second, 2147483647.0)});
    inputs.set("iTimeDelta", {0, 1});
    inputs.set("iFrameRate", {0, k_frames_a_second});
    inputs.set("iChannelTime", std::array{time, time, time, time});
    inputs.set("iDate", std::array<Interval, 4>{{{0, 9999}, {0, 11}, {1, 31}, {0, 86400}}});
}

void turn_knobs(Inputs& inputs, const std::vector<scene::Knob>& knobs) {
    for (const scene::Knob& knob : knobs) {
        if (!knob.range)
            continue;
        std::array<Interval, 4> ranges;
        for (size_t i = 0; i < ranges.size(); ++i)
            ranges[i] = {knob.range->low[i], knob.range->high[i]};
        inputs.set(knob.name, ranges);
    }
}

/// What a sampler may give where that is not what the last frame left.
std::optional<Interval> changing(const scene::Pass& pass, const std::string& sampler) {
    const auto name = std::ranges::find(scene::k_channel_names, sampler);
    const auto channel = size_t(name - scene::k_channel_names.begin());
    if (channel >= pass.channels.size())
        return std::nullopt;
    switch (scene::traits_of(pass.channels[channel].input).changes) {
    case scene::Changes::never: return std::nullopt;
    case scene::Changes::with_passes: return ir::everything(false);
    case scene::Changes::with_clock:
    case scene::Changes::with_keys: return Interval{0, 1};
    }
    return std::nullopt;
}

/// The device may choose another level, whose texels lie among those of the base.
Interval looked_up(const ir::TextureSet& textures, const ir::Lookup& lookup,
                   std::span<const Interval> operands) {
    const auto texels = textures.find(lookup.sampler);
    if (texels == textures.end() || !texels->second->chooses_level(lookup))
        return ir::look_up(textures, lookup, operands);
    const std::vector<Interval> anywhere(operands.size(), ir::everything(false));
    return ir::look_up(textures, lookup, anywhere);
}

} // namespace

ir::ValueRanges ranges_of(const DrawnPass& drawn, double seconds) {
    Inputs inputs(drawn);
    const auto [width, height] = drawn.renderer.extent();
    inputs.set("gl_FragCoord",
               std::array<Interval, 4>{{{0.5, width - 0.5}, {0.5, height - 0.5}, {0.5, 0.5}, {1, 1}}});
    let_time_pass(inputs, seconds);
    turn_knobs(inputs, drawn.renderer.scene().knobs);
    const ir::TextureSet textures = textures_of(drawn.renderer, drawn.pass);
    const scene::Pass& pass = drawn.renderer.scene().passes[drawn.pass];
    return ir::value_ranges(drawn.function.function(), inputs.memory(),
                            [&](const ir::Lookup& lookup, std::span<const Interval> operands) {
                                const auto any = changing(pass, lookup.sampler);
                                return any ? *any : looked_up(textures, lookup, operands);
                            });
}

} // namespace tidemark::lab
