#include "lab/pixel/pixel_trace.hpp"

#include "base/try.hpp"
#include "lab/march/pass_textures.hpp"
#include "lab/pixel/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

using ir::Ended;
using ir::Op;

/// Takes about five seconds.
constexpr uint64_t k_most_operations = 50'000'000;

/// Returns an evaluator of all three numbers, with the uniforms and the place of `pixel`.
ir::LockstepEvaluator in_lockstep(const ir::Function& function, const ir::FloatEvaluator& pixel,
                                  uint64_t seed) {
    ir::LockstepEvaluator evaluator(function, ir::LockstepSystem(seed));
    for (size_t cell = 0; cell < pixel.memory().size(); ++cell)
        evaluator.memory()[cell] = ir::LockstepSystem::exactly(pixel.memory()[cell]);
    evaluator.most_steps = k_most_operations;
    return evaluator;
}

/// Looks up each of the three numbers at its own place; sets `base_level` if the device would choose a mipmap
/// level.
ir::Textures<ir::Lockstep> looked_up(const ir::TextureSet& textures, bool& base_level) {
    return [&](const ir::Lookup& lookup, std::span<const ir::Lockstep> operands) {
        const auto texels = textures.find(lookup.sampler);
        base_level = base_level || (texels != textures.end() && texels->second->chooses_level(lookup));
        const auto at = [&]<class Real>(auto member) {
            std::vector<ir::Point<Real>> places;
            for (const ir::Lockstep& operand : operands)
                places.push_back(member(operand));
            return ir::look_up(textures, lookup, std::span<const ir::Point<Real>>(places));
        };
        ir::Lockstep found{at.operator()<float>([](const auto& each) { return each.in_float; }),
                           at.operator()<double>([](const auto& each) { return each.in_double; }),
                           {}};
        for (size_t i = 0; i < found.samples.size(); ++i)
            found.samples[i] = at.operator()<float>([i](const auto& each) { return each.samples[i]; });
        return found;
    };
}

bool is_unknown(const ir::Function& function, const ir::Instruction& instruction,
                const ir::TextureSet& textures) {
    if (instruction.op != Op::texel)
        return instruction.op == Op::derivative_x || instruction.op == Op::derivative_y;
    const ir::Lookup& lookup = function.lookups[instruction.immediate];
    return !textures.contains(lookup.sampler) || lookup.form == ir::Lookup::Form::gather ||
           lookup.form == ir::Lookup::Form::query;
}

/// Returns, for each block, the first instruction whose value the evaluator cannot compute.
std::vector<ir::Value> unknown_values(const ir::Function& function, const ir::TextureSet& textures) {
    std::vector<ir::Value> result(function.blocks.size(), ir::k_no_value);
    for (size_t block = 0; block < result.size(); ++block)
        for (ir::Value i = function.blocks[block].last; i-- > function.blocks[block].first;)
            if (is_unknown(function, function.instructions[i], textures))
                result[block] = i;
    return result;
}

Error not_followed(const PassFunction& function, ir::Value value) {
    const ir::Instruction& instruction = function.function().instructions[value];
    return error_at(function.locate(instruction.line),
                    instruction.op == Op::texel
                        ? "the pixel reads a texture here that is not at hand: of the frame before, or too "
                          "large, or by textureGather or textureQueryLod"
                        : "the pixel takes a derivative here: neighbours are not followed yet");
}

void read_colour(const ir::LockstepEvaluator& evaluator, const ir::Function& function, PixelTrace& trace) {
    const auto output =
        std::ranges::find(function.variables, ir::Variable::Kind::output, &ir::Variable::kind);
    if (output == function.variables.end())
        return;
    for (uint32_t i = 0; i < std::min<size_t>(output->size, trace.in_float.size()); ++i) {
        const ir::Lockstep& component = evaluator.memory()[output->first + i];
        trace.in_float[i] = component.in_float.real;
        trace.in_double[i] = component.in_double.real;
        trace.digits[i] = ir::significant_digits({&component.samples, 1});
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
                          const ir::FloatEvaluator& pixel, const ir::TextureSet& textures,
                          const PixelRequest& request) {
    std::optional<int> line;
    if (request.line)
        line = TRY(lines.compiled_line(*request.line));
    ir::LockstepEvaluator evaluator = in_lockstep(function.function(), pixel, request.seed);
    Recorder recorder(function.function(), lines, line, request.turns);
    PixelTrace trace;
    if (line)
        trace.asked = *lines.find(*line);
    evaluator.textures = looked_up(textures, trace.at_base_level);
    const std::vector<ir::Value> unknown = unknown_values(function.function(), textures);
    ir::Value found = ir::k_no_value;
    ir::Decisions decisions(0);
    const Ended ended = evaluator.run(decisions, [&](uint32_t block) {
        const ir::Block& here = function.function().blocks[block];
        trace.operations += here.last - here.first;
        found = unknown[block];
        recorder.record(evaluator, block);
        return found == ir::k_no_value;
    });
    if (found != ir::k_no_value)
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
    const auto function = TRY(PassFunction::create(renderer.scene(), pass, ir::Names::keep));
    ir::FloatEvaluator pixel = function.frame(renderer, renderer.shown_index(), inputs);
    function.move_to(pixel, request.pixel);
    auto trace = TRY(follow(function, PassLines(function, renderer.scene(), pass), pixel,
                            textures_of(renderer, renderer.shown_index()), request));
    trace.on_device = colour_at(renderer.read_floats(renderer.shown_index()), request.pixel);
    return trace;
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
