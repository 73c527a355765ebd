// Proves that no NaN can arise, by value ranges of each pass over all pixels, a span of time and the knobs'
// ranges. Passes may read each other: if no pass makes a NaN from numbers, this holds for all frames.
#include "base/try.hpp"
#include "lab/check/probes.hpp"
#include "lab/march/pass_ranges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

constexpr Extent k_usual_size{640, 360};

std::string range(const ir::Interval& interval) {
    if (interval.low < -1e30 && interval.high > 1e30)
        return "any number";
    return interval.low == interval.high ? fmt::format("{:.4g}", interval.low)
                                         : fmt::format("[{:.4g}, {:.4g}]", interval.low, interval.high);
}

/// Describes an operation and its operands.
std::string operation(const ir::Function& function, const ir::PartialOperation& what) {
    if (what.value == ir::k_no_value || what.operands.empty())
        return "a number that is infinite, or an input that may be NaN";
    const ir::Interval& a = what.operands[0];
    const ir::Interval& b = what.operands.back();
    switch (function.instructions[what.value].op) {
    case ir::Op::sqrt: return "sqrt of " + range(a);
    case ir::Op::inverse_sqrt: return "normalize or inversesqrt, of a square that is in " + range(a);
    case ir::Op::divide: return "a division by " + range(b);
    case ir::Op::modulo: return "mod by " + range(b);
    case ir::Op::log:
    case ir::Op::log2: return "log of " + range(a);
    case ir::Op::pow: return fmt::format("pow of {} to {}", range(a), range(b));
    case ir::Op::asin:
    case ir::Op::acos: return "asin or acos of " + range(a);
    case ir::Op::atan2: return fmt::format("atan of {} and {}", range(a), range(b));
    case ir::Op::texel: return "a texture that is not followed";
    default: return "an operation on " + range(a);
    }
}

/// Returns why the pass may make a NaN; empty if it cannot.
Result<std::string> doubt_of(const render::Renderer& renderer, size_t index, const FrameState& state,
                             double seconds) {
    const scene::Pass& pass = renderer.scene().passes[index];
    if (pass.kind == scene::PassKind::cubemap)
        return pass.name + " is a cubemap, which is not followed";
    const auto function = PassFunction::create(renderer.scene(), pass);
    if (!function)
        return "the text cannot be followed: " + function.error().message;
    const ir::ValueRanges ranges = ranges_of({*function, renderer, index, render::inputs_of(state)}, seconds);
    if (!ranges.settled)
        return pass.name + " has too many loops in each other";
    for (const ir::Variable& variable : function->function().variables) {
        if (variable.kind != ir::Variable::Kind::output)
            continue;
        for (uint32_t cell = variable.first; cell < variable.first + std::min(variable.size, 4u); ++cell)
            if (const auto& doubt = ranges.partial[cell]) {
                const int line =
                    doubt->value == ir::k_no_value ? 0 : function->function().instructions[doubt->value].line;
                const SourceLocation where = function->locate(line);
                return fmt::format("{}:{}: {}", where.file, where.line,
                                   operation(function->function(), *doubt));
            }
    }
    return std::string();
}

bool is_finite(const image::Image& picture) {
    return std::ranges::none_of(picture.f32(), [](float sample) { return std::isnan(sample); });
}

} // namespace

Result<Answer> ask_no_nan(ProbeBench& bench) {
    const FrameState state = state_at(1.0 / 3, k_usual_size);
    const double seconds = bench.promises().time_horizon;
    const render::Renderer& renderer = *TRY(bench.drawn(state));
    for (const render::PlannedPass& planned : renderer.plan().passes)
        if (const std::string doubt = TRY(doubt_of(renderer, planned.pass, state, seconds)); !doubt.empty())
            return Answer{Verdict::not_applicable, "not excluded: " + doubt};
    if (!is_finite(renderer.read_back()))
        return Answer{Verdict::not_applicable, "a picture contradicts its proof: please report this scene"};
    return Answer{
        Verdict::pass,
        fmt::format("no operation can leave its domain, in any pixel of {}x{}, from 0 to {:g} s, with "
                    "every knob anywhere in its range; only what is too large for a float is not "
                    "looked at",
                    k_usual_size.width, k_usual_size.height, seconds)};
}

} // namespace tidemark::lab
