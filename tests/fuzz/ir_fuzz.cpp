// Any text as a function in SSA form: compiled, evaluated in float, in intervals and with slopes. It ends,
// and what intervals say of a ray holds for the floats on it.
#include "fuzz.hpp"
#include "proof/ray_proofs.hpp"
#include "proof/spirv.hpp"
#include "proof/value_ranges.hpp"

#include <cmath>
#include <string>

using namespace tidemark;

namespace {

constexpr size_t k_longest_text = 4096;
constexpr uint64_t k_most_steps = 200'000;
constexpr uint64_t k_most_evaluations = 100;

void look_along(const proof::Function& function, const std::vector<proof::MarchingLoop>& loops,
                proof::FloatEvaluator pixel) {
    const auto index = proof::enter_first(pixel, loops);
    if (!index)
        return;
    const proof::MarchingLoop& loop = loops[*index];
    const proof::FloatEvaluator entered = pixel;
    const proof::March march = proof::follow(pixel, function, loop);
    const proof::LoopSlice turn = proof::slice_of(function, loop);
    if (march.turns.empty() || !proof::is_faithful(turn, entered, march))
        return;
    proof::MarchSlice slice(turn, entered);
    const double end = slice.end(march);
    if (end <= slice.start())
        return;
    const proof::FirstHit hit = proof::first_hit(slice, end, k_most_evaluations);
    REQUIRE(hit.where.low <= hit.where.high);
    if (hit.verdict == proof::FirstHit::Verdict::hit)
        REQUIRE(proof::step_scale(slice, hit.where, k_most_evaluations).safe >= 0);
}

void set_x(const proof::Function& function, auto& memory, auto x) {
    if (const proof::Variable* place = function.find("gl_FragCoord"))
        memory[place->first] = x;
}

/// Checks that a pixel's floats lie within the ranges of all pixels.
void look_at_ranges(const proof::Function& function) {
    std::vector<proof::Interval> memory(function.cells.size());
    set_x(function, memory, proof::Interval{0.5, 80.5});
    const auto black = [](const proof::Lookup&, std::span<const proof::Interval>) {
        return proof::Interval{0, 0};
    };
    const proof::ValueRanges ranges = proof::value_ranges(function, memory, black);
    const proof::Variable* color = function.find("color");
    if (!ranges.settled || !color)
        return;
    for (const float x : {0.5f, 1.5f, 33.5f, 80.5f}) {
        proof::FloatEvaluator pixel(function);
        pixel.most_steps = k_most_steps;
        pixel.textures = [](const proof::Lookup&, std::span<const proof::Point<float>>) {
            return proof::Point<float>{};
        };
        pixel.derivative = [](proof::Op, proof::Value) { return proof::Point<float>{}; };
        set_x(function, pixel.memory(), proof::Point<float>{x, 0});
        proof::Decisions none(0);
        if (pixel.run(none, [](uint32_t) { return true; }) != proof::Ended::left)
            continue;
        for (uint32_t cell = color->first; cell < color->first + color->size; ++cell) {
            const float found = pixel.memory()[cell].real;
            REQUIRE(ranges.partial[cell] || std::isinf(found) || ranges.memory[cell].contains(found) ||
                    ranges.memory[cell].high > 1e37 || ranges.memory[cell].low < -1e37);
        }
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size > k_longest_text)
        return 0;
    const std::string text = "#version 450 core\nuniform float iTime;\nuniform sampler2D iChannel0;\n"
                             "layout(location = 0) out vec4 color;\n" +
                             std::string(text_of(data, size));
    const auto function = proof::compile(text);
    if (!function) {
        REQUIRE(!function.error().message.empty());
        return 0;
    }
    look_at_ranges(*function);
    const auto loops = proof::find_marching_loops(*function);
    for (const float x : {0.5f, 80.5f}) {
        proof::FloatEvaluator pixel(*function);
        pixel.most_steps = k_most_steps;
        if (const proof::Variable* place = function->find("gl_FragCoord"))
            pixel.memory()[place->first].real = x;
        look_along(*function, loops, pixel);
    }
    return 0;
}
