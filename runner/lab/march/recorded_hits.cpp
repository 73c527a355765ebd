#include "lab/march/recorded_hits.hpp"

#include "base/try.hpp"
#include "render/frame_stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

namespace tidemark::lab {
namespace {

/// Approximate number of pixels that are compared with the CPU.
constexpr double k_compared = 900;
/// A march with an iteration more or less ends within its threshold of the same place.
constexpr float k_same_place = 2e-3f;
constexpr float k_same_turns = 0.05f;
constexpr double k_least_agreeing = 0.9;

/// Returns the index of the carried value that is the ray's parameter itself.
std::optional<size_t> parameter_of(const ir::MarchingLoop& loop) {
    for (size_t i = 0; i < loop.carried.size(); ++i)
        if (loop.by_parameter() || loop.carried[i].factors.empty())
            return i;
    return std::nullopt;
}

/// Returns each loop of the text once: one that is called from several places is inlined several times.
std::vector<glsl::MarchLines> marches_of(const PassFunction& image) {
    std::vector<glsl::MarchLines> marches;
    for (const ir::MarchingLoop& loop : image.loops())
        if (glsl::MarchLines lines = lines_of(image, loop);
            std::ranges::find(marches, lines) == marches.end())
            marches.push_back(std::move(lines));
    return marches;
}

/// Copies Common into each pass, so that Image's copy can be changed.
void inline_common(scene::Scene& scene) {
    for (scene::Pass& pass : scene.passes) {
        text::MappedText whole = scene.common;
        whole.append(pass.text);
        pass.text = std::move(whole);
    }
    scene.common = {};
}

image::Image answer(render::Renderer& renderer, glsl::RecordAnswer which, const render::FrameState& state) {
    ask(renderer, which);
    render::FrameStepper(renderer, state).draw(state.frame);
    return renderer.read_back();
}

/// Lets NaN equal itself in comparisons.
uint32_t as_bits(float value) {
    return std::bit_cast<uint32_t>(value);
}

size_t differing_colours(const image::Image& a, const image::Image& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.extent.pixels(); ++i)
        count +=
            !std::ranges::equal(a.f32().subspan(4 * i, 3), b.f32().subspan(4 * i, 3), {}, as_bits, as_bits);
    return count;
}

/// The march of a pixel on the CPU.
struct CpuMarch {
    bool textured = false;
    ir::March march;
    float place = 0; ///< place on the ray of the last distance measured
};

float place_of(const ir::MarchingLoop& loop, const ir::FloatEvaluator& entered, const ir::Turn& turn) {
    if (const auto parameter = parameter_of(loop))
        return turn.carried[*parameter];
    float squares = 0;
    for (size_t i = 0; i < turn.carried.size(); ++i) {
        const float way = turn.carried[i] - entered.value(loop.carried[i].phi).real;
        squares += way * way;
    }
    return std::sqrt(squares);
}

/// Runs the pixel that `evaluator` is set to; nullopt if it enters no marching loop.
std::optional<CpuMarch> march_of(const PassFunction& image, ir::FloatEvaluator& evaluator) {
    CpuMarch result;
    evaluator.textures = [&](const ir::Lookup&, std::span<const ir::Point<float>>) {
        result.textured = true;
        return ir::Point<float>{};
    };
    const auto entered = ir::enter_first(evaluator, image.loops());
    if (!entered)
        return std::nullopt;
    const ir::MarchingLoop& loop = image.loops()[*entered];
    const ir::FloatEvaluator at_entry = evaluator;
    result.march = ir::follow(evaluator, image.function(), loop);
    if (!result.march.turns.empty())
        result.place = place_of(loop, at_entry, result.march.turns.back());
    return result;
}

bool same_place(float a, float b) {
    return (std::isnan(a) && std::isnan(b)) ||
           std::abs(a - b) <= k_same_place * std::max({1.0f, std::abs(a), std::abs(b)});
}

/// The end of a march that goes astray far away depends on rounding, so only the places of hits are compared.
bool agrees(const CpuMarch& cpu, const float* recorded) {
    const auto turns = float(cpu.march.turns.size());
    if (turns == 0 || recorded[1] == 0)
        return turns == recorded[1];
    const bool hit = recorded[2] <= recorded[3];
    return hit == cpu.march.hit && std::abs(recorded[1] - turns) <= std::max(1.0f, k_same_turns * turns) &&
           (!hit || same_place(recorded[0], cpu.place));
}

} // namespace

glsl::MarchLines lines_of(const PassFunction& image, const ir::MarchingLoop& loop) {
    const ir::Function& function = image.function();
    const ir::Instruction& comparison = function.instructions[loop.comparison];
    glsl::MarchLines lines;
    lines.test = image.locate(loop.line);
    lines.comparisons = loop.comparisons;
    lines.which = loop.which;
    lines.distance_is_less = function.operands_of(comparison)[0] == loop.distance;
    const auto parameter = parameter_of(loop);
    for (size_t i = 0; i < loop.carried.size(); ++i)
        if (!parameter || i == *parameter)
            lines.updates.push_back(image.locate(function.instructions[loop.carried[i].update].line));
    lines.at_update = loop.cut_at_update;
    lines.fixed_steps = loop.kind == ir::MarchingLoop::Kind::fixed_step;
    lines.in_next_turn = loop.in_next_turn;
    lines.stops_before = loop.stops_before;
    return lines;
}

Result<Recording> record_hits(const scene::Scene& scene, const PassFunction& image) {
    if (image.loops().empty())
        return fail(ErrorCode::load, "no loop of Image is found to march along a ray");
    const std::vector<glsl::MarchLines> marches = marches_of(image);
    Recording recording{scene, std::ranges::all_of(marches, &glsl::MarchLines::stops_before),
                        std::ranges::all_of(marches, &glsl::MarchLines::fixed_steps)};
    inline_common(recording.scene);
    scene::Pass& pass = recording.scene.passes[recording.scene.image_index()];
    const auto text = TRY(glsl::ParsedText::read(pass.text, glsl::k_site_macros));
    pass.text = TRY(glsl::record_marches(*text, glsl::find_facts(*text), marches));
    pass.kind = scene::PassKind::hit;
    recording.scene.knobs.push_back({.name = std::string(glsl::k_record_knob)});
    return recording;
}

void ask(render::Renderer& recording, glsl::RecordAnswer answer) {
    std::vector<scene::Knob> knobs = recording.scene().knobs;
    knobs.back().value = {double(answer)};
    recording.turn(std::move(knobs));
}

RecordingCheck check_recording(render::Renderer& plain, render::Renderer& recording,
                               const PassFunction& image, const render::FrameState& state) {
    RecordingCheck check;
    render::FrameStepper(plain, state).draw(state.frame);
    check.other_pixels =
        differing_colours(plain.read_back(), answer(recording, glsl::RecordAnswer::picture, state));
    const image::Image marches = answer(recording, glsl::RecordAnswer::march, state);
    answer(recording, glsl::RecordAnswer::hit, state);
    const ir::FloatEvaluator frame = image.frame(plain, plain.scene().image_index(), inputs_of(state));
    const Extent extent = plain.extent();
    const int stride = std::max(1, int(std::sqrt(double(extent.pixels()) / k_compared)));
    for (int y = stride / 2; y < extent.height; y += stride)
        for (int x = stride / 2; x < extent.width; x += stride) {
            ir::FloatEvaluator pixel = frame;
            image.move_to(pixel, {x, y});
            const auto cpu = march_of(image, pixel);
            if (!cpu)
                continue;
            ++check.rays;
            check.textured += cpu->textured;
            check.agree += !cpu->textured && agrees(*cpu, &marches.f32()[4 * size_t(y * extent.width + x)]);
        }
    return check;
}

std::string refusal_of(const RecordingCheck& check) {
    if (check.other_pixels > 0)
        return fmt::format("the text that records draws {} other pixels", check.other_pixels);
    if (check.rays == 0)
        return "no ray comes to the loop that marches";
    if (double(check.agree) < k_least_agreeing * double(check.compared()))
        return fmt::format("of {} rays only {} are recorded as they are computed from the text",
                           check.compared(), check.agree);
    return {};
}

} // namespace tidemark::lab
