// Any text as a function in SSA form: compiled, evaluated in float, in intervals and with slopes. It ends, and
// what intervals say of a ray holds for the floats on it.
#include "fuzz.hpp"
#include "ir/first_hit.hpp"
#include "ir/spirv.hpp"
#include "ir/step_scale.hpp"

#include <cmath>
#include <string>

using namespace tidemark;

namespace {

constexpr size_t k_longest_text = 4096;
constexpr uint64_t k_most_steps = 200'000;
constexpr uint64_t k_most_evaluations = 100;

void look_along(const ir::Function& function, const std::vector<ir::MarchingLoop>& loops,
                ir::FloatEvaluator pixel) {
    const auto index = ir::enter_first(pixel, loops);
    if (!index)
        return;
    const ir::MarchingLoop& loop = loops[*index];
    const ir::FloatEvaluator entered = pixel;
    const ir::March march = ir::follow(pixel, function, loop);
    if (march.turns.empty() || !ir::is_faithful(loop, entered, march))
        return;
    ir::MarchSlice slice(function, loop, entered);
    const double end = slice.end(march);
    if (!std::isfinite(end) || end <= slice.start())
        return;
    const ir::FirstHit hit = ir::first_hit(slice, end, k_most_evaluations);
    REQUIRE(hit.where.low <= hit.where.high);
    if (hit.verdict == ir::FirstHit::Verdict::hit)
        REQUIRE(ir::step_scale(slice, hit.where, k_most_evaluations).safe >= 0);
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size > k_longest_text)
        return 0;
    const std::string text = "#version 450 core\nuniform float iTime;\nuniform sampler2D iChannel0;\n"
                             "layout(location = 0) out vec4 color;\n" +
                             std::string(text_of(data, size));
    const auto function = ir::compile(text);
    if (!function) {
        REQUIRE(!function.error().message.empty());
        return 0;
    }
    const auto loops = ir::find_marching_loops(*function);
    for (const float x : {0.5f, 80.5f}) {
        ir::FloatEvaluator pixel(*function);
        pixel.most_steps = k_most_steps;
        if (const ir::Variable* place = function->find("gl_FragCoord"))
            pixel.memory()[place->first].real = x;
        look_along(*function, loops, pixel);
    }
    return 0;
}
