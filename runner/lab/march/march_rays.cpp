#include "lab/march/march_rays.hpp"

#include "lab/march/pass_textures.hpp"

#include <utility>

namespace tidemark::lab {

MarchRays::MarchRays(DrawnPass drawn)
    : drawn_(std::move(drawn)), textures_(textures_of(drawn_.renderer, drawn_.pass)),
      floats_(drawn_.function.frame<float>(drawn_.renderer, drawn_.pass, drawn_.inputs)),
      doubles_(drawn_.function.frame<double>(drawn_.renderer, drawn_.pass, drawn_.inputs)) {
    floats_.textures = ir::textures_in<ir::Point<float>>(textures_);
    doubles_.textures = ir::textures_in<ir::Point<double>>(textures_);
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

} // namespace tidemark::lab
