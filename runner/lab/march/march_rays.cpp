#include "lab/march/march_rays.hpp"

#include "lab/march/pass_textures.hpp"

#include <utility>

namespace tidemark::lab {

MarchRays::MarchRays(DrawnPass drawn)
    : drawn_(std::move(drawn)), ranges_(drawn_), textures_(textures_of(drawn_.renderer, drawn_.pass)),
      floats_(drawn_.function.frame<float>(drawn_.renderer, drawn_.pass, drawn_.inputs)),
      doubles_(drawn_.function.frame<double>(drawn_.renderer, drawn_.pass, drawn_.inputs)) {
    floats_.textures = ir::textures_in<ir::Point<float>>(textures_);
    doubles_.textures = ir::textures_in<ir::Point<double>>(textures_);
    for (const ir::MarchingLoop& loop : drawn_.function.loops()) {
        auto& step = steps_.emplace_back();
        if (loop.advance != ir::k_no_value)
            step = ir::slice_of(drawn_.function.function(), loop, ir::SliceOf::step);
    }
}

std::optional<MarchRay> MarchRays::enter(glm::ivec2 pixel, ir::Surface surface) const {
    const PassFunction& function = drawn_.function;
    ir::FloatEvaluator in_float = floats_;
    ir::PointEvaluator<double> in_double = doubles_;
    function.move_to(in_float, pixel);
    function.move_to(in_double, pixel);
    const auto index = ir::enter_first(in_float, function.loops());
    const bool both = index == ir::enter_first(in_double, function.loops());
    if (!index && both)
        return std::nullopt;
    MarchRay ray;
    if (!index || !both)
        return ray;
    ray.loop = *index;
    const ir::LoopSlice& slice = function.slices()[*index];
    const ir::FloatEvaluator entered = in_float;
    ray.march = ir::follow(in_float, function.function(), slice.loop);
    if (!ir::is_faithful(slice, entered, ray.march))
        return ray;
    ray.slice.emplace(slice, in_double, ir::textures_in<ir::Interval>(textures_), surface);
    ray.in_float.emplace(slice, entered);
    return ray;
}

ir::Textures<ir::Interval> MarchRays::textures_of_all(bool at_any_time) const {
    return [this, at_any_time](const ir::Lookup& lookup, std::span<const ir::Interval> operands) {
        const auto any = at_any_time ? changing(drawn_, lookup.sampler) : std::nullopt;
        return any ? *any : ir::look_up(textures_, lookup, operands, ir::UnnamedLevel::any);
    };
}

std::optional<AreaRays> MarchRays::enter_all(const RayArea& area, ir::SliceOf what,
                                             ir::Surface surface) const {
    InputRanges ranges = ranges_;
    ranges.set_place(area.x, area.y);
    if (area.time)
        ranges.set_time(*area.time);
    ir::Evaluator<ir::IntervalSystem> all(drawn_.function.function());
    all.memory() = ranges.memory();
    all.textures = textures_of_all(area.time.has_value());
    const auto index = ir::enter_first(all, drawn_.function.loops());
    if (!index || (what == ir::SliceOf::step && !steps_[*index]))
        return std::nullopt;
    const ir::LoopSlice& slice =
        what == ir::SliceOf::step ? *steps_[*index] : drawn_.function.slices()[*index];
    return AreaRays{*index, ir::MarchSlice(slice, all, all.textures, surface)};
}

} // namespace tidemark::lab
