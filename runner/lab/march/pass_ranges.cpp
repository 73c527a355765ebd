#include "lab/march/pass_ranges.hpp"

#include "lab/march/input_ranges.hpp"
#include "lab/march/pass_textures.hpp"

namespace tidemark::lab {

ir::ValueRanges ranges_of(const DrawnPass& drawn, double seconds) {
    InputRanges inputs(drawn);
    const auto [width, height] = drawn.renderer.extent();
    inputs.set_place({0.5, width - 0.5}, {0.5, height - 0.5});
    inputs.set_time({0, seconds});
    inputs.turn_knobs();
    const ir::TextureSet textures = textures_of(drawn.renderer, drawn.pass);
    return ir::value_ranges(drawn.function.function(), inputs.memory(),
                            [&](const ir::Lookup& lookup, std::span<const ir::Interval> operands) {
                                const auto any = changing(drawn, lookup.sampler);
                                return any ? *any
                                           : ir::look_up(textures, lookup, operands, ir::UnnamedLevel::any);
                            });
}

} // namespace tidemark::lab
