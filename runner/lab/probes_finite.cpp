// Looks for NaN and infinity by drawing the scene in many situations and counting bits on the CPU.

#include "base/error.hpp"
#include "lab/exploration.hpp"
#include "lab/march_rays.hpp"
#include "lab/probed_pictures.hpp"
#include "lab/probes.hpp"
#include "media/image.hpp"
#include "render/gl_context.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace tidemark::lab {
namespace {

scene::KnobValue middle_of(const scene::Knob& knob) {
    scene::KnobValue value{};
    for (size_t i = 0; i < value.size(); ++i) {
        value[i] = (knob.range->low[i] + knob.range->high[i]) / 2;
        if (scene::info(knob.type).whole)
            value[i] = std::floor(value[i]);
    }
    return value;
}

/// The largest magnitudes of a pass, frame after frame.
class Growth {
public:
    void add(const image::Image& picture) {
        double largest = 0;
        for (const float sample : picture.f32())
            if (std::isfinite(sample))
                largest = std::max(largest, double(std::abs(sample)));
        largest_.push_back(largest);
    }

    /// Returns the frame at which the numbers overflow if they go on as they do: by about the same factor in
    /// each third of the last half of the frames. Nothing if they do not grow so, or have not grown much.
    std::optional<double> overflow_frame() const {
        constexpr size_t k_fewest = 60;
        constexpr double k_much = 100, k_steady = 0.8, k_latest = 1e6;
        const size_t count = largest_.size(), part = count / 6;
        if (count < k_fewest || !(largest_.back() > k_much * largest_[count / 2]) || largest_.back() < k_much)
            return std::nullopt;
        double last = 0;
        for (size_t third = 0; third < 3; ++third) {
            const double before = largest_[count - 1 - (3 - third) * part],
                         after = largest_[count - 1 - (2 - third) * part];
            const double rate = before > 0 ? std::log(after / before) / double(part) : 0;
            if (!(rate > 0) || rate < k_steady * last)
                return std::nullopt;
            last = rate;
        }
        const double frame =
            double(count) + std::log(double(std::numeric_limits<float>::max()) / largest_.back()) / last;
        return frame < k_latest ? std::optional(frame) : std::nullopt;
    }

    double largest() const { return largest_.back(); }

private:
    std::vector<double> largest_{};
};

/// Returns the lines of a pass that make its number larger from frame to frame, the last one first: those
/// that multiply what it reads from `samplers` by a constant above 1; if there are none, those that add or
/// scale such values.
std::vector<SourceLocation> growing_lines(const PassFunction& pass, const std::set<std::string>& samplers) {
    const proof::Function& function = pass.function();
    std::vector<bool> read(function.instructions.size());
    std::vector<bool> stored(function.accesses.size());
    const auto overlaps_stored = [&](uint32_t access) {
        for (size_t i = 0; i < stored.size(); ++i)
            if (stored[i] && proof::overlap(function.accesses[i], function.accesses[access]))
                return true;
        return false;
    };
    for (const int round : {0, 1}) // the second one goes through the phis of loops
        for (proof::Value i = 0; i < read.size(); ++i) {
            const proof::Instruction& each = function.instructions[i];
            const auto operands = function.operands_of(each);
            if (each.op == proof::Op::texel)
                read[i] = samplers.contains(function.lookups[each.immediate].sampler);
            else
                read[i] = (each.op == proof::Op::load && overlaps_stored(each.immediate)) ||
                          std::ranges::any_of(operands, [&](proof::Value value) {
                              return (round > 0 || value < i) && read[value];
                          });
            if (each.op == proof::Op::store && read[i])
                stored[each.immediate] = true;
        }
    std::vector<SourceLocation> multiplied, added;
    const auto note = [&](std::vector<SourceLocation>& list, int line) {
        SourceLocation where = pass.locate(line);
        if (!where.file.empty() && std::ranges::find(list, where) == list.end())
            list.push_back(std::move(where));
    };
    for (proof::Value i = proof::Value(read.size()); i-- > 0;) {
        const proof::Instruction& each = function.instructions[i];
        const auto operands = function.operands_of(each);
        if (!read[i] || each.type != proof::Scalar::real || operands.size() != 2)
            continue;
        const bool both = read[operands[0]] && read[operands[1]];
        const auto constant = [&](proof::Value value) {
            const proof::Instruction& other = function.instructions[value];
            return other.op == proof::Op::constant ? std::optional(std::bit_cast<float>(other.immediate))
                                                   : std::nullopt;
        };
        const bool product = each.op == proof::Op::multiply, quotient = each.op == proof::Op::divide;
        const bool sum = both && (each.op == proof::Op::add || each.op == proof::Op::subtract);
        const auto factor = both ? std::nullopt : constant(operands[read[operands[0]] ? 1 : 0]);
        const bool by_quotient = quotient && read[operands[0]];
        if ((product && (both || (factor && std::abs(*factor) > 1))) ||
            (by_quotient && factor && std::abs(*factor) < 1))
            note(multiplied, each.line);
        else if (sum || product || by_quotient)
            note(added, each.line);
    }
    return multiplied.empty() ? added : multiplied;
}

/// Returns the growing lines of the scene's pass of that name.
std::vector<SourceLocation> growing_lines(ProbeBench& bench, const std::string& name,
                                          const std::set<std::string>& growing) {
    const scene::Scene& scene = bench.scene();
    for (size_t i = 0; i < scene.passes.size(); ++i) {
        const scene::Pass& pass = scene.passes[i];
        if (pass.name != name)
            continue;
        const auto& function = bench.function_of(i);
        if (!function)
            return {};
        std::set<std::string> samplers;
        for (size_t channel = 0; channel < pass.channels.size(); ++channel)
            if (const size_t* const source = scene::source_pass(pass.channels[channel].input);
                source && growing.contains(scene.passes[*source].name))
                samplers.insert(std::string(scene::k_channel_names[channel]));
        return growing_lines(*function, samplers);
    }
    return {};
}

/// Returns the answer for the pass that overflows first; nothing if none grows without end.
std::optional<Answer> overflow(ProbeBench& bench, const std::vector<std::pair<std::string, Growth>>& passes,
                               const FrameState& last) {
    const std::pair<std::string, Growth>* worst = nullptr;
    double first = std::numeric_limits<double>::infinity();
    std::set<std::string> growing;
    for (const auto& pass : passes) {
        const auto frame = pass.second.overflow_frame();
        if (frame)
            growing.insert(pass.first);
        if (worst && pass.first == bench.scene().image().name)
            continue; // it shows what grows elsewhere
        if (frame && *frame < first) {
            first = *frame;
            worst = &pass;
        }
    }
    if (!worst)
        return std::nullopt;
    Answer answer{
        Verdict::warn,
        fmt::format("{} grows by the same factor again and again: its largest number is {:.2g} at frame "
                    "{}, and at about frame {:.0f} ({:.0f} s) it overflows",
                    worst->first, worst->second.largest(), last.frame, first, first / last.fps),
        last};
    answer.effect = fmt::format("{} grows from frame to frame and overflows at about {:.0f} s", worst->first,
                                first / last.fps);
    for (SourceLocation& where : growing_lines(bench, worst->first, growing))
        add_place(answer, std::move(where));
    return answer;
}

} // namespace

Result<Answer> ask_times(ProbeBench& bench) {
    return look(bench, usual_moments());
}

Result<Answer> ask_frames(ProbeBench& bench) {
    constexpr int k_frames = 600; // ten seconds at 60 frames per second
    constexpr std::chrono::seconds k_patience(5);
    const auto feedback = TRY(bench.has_feedback());
    if (!feedback)
        return Answer{Verdict::not_applicable, "no frame depends on the one before it"};
    std::optional<Answer> fault;
    int seen = 0;
    std::vector<std::pair<std::string, Growth>> growth;
    FrameState last;
    const auto start = std::chrono::steady_clock::now();
    const auto done = bench.step([&](const FrameState& at, const std::vector<PassPicture>& passes) {
        fault = not_finite(bench, at, passes);
        growth.resize(std::max(growth.size(), passes.size()));
        for (size_t i = 0; i < passes.size(); ++i) {
            growth[i].first = passes[i].pass;
            growth[i].second.add(passes[i].picture);
        }
        last = at;
        return !fault && ++seen < k_frames && std::chrono::steady_clock::now() - start < k_patience;
    });
    if (!done)
        return fail(done.error());
    if (fault)
        fault->sentence = fmt::format("from frame {} on: {}", seen, fault->sentence);
    else
        fault = overflow(bench, growth, last);
    return fault ? *std::move(fault)
                 : Answer{Verdict::pass, fmt::format("no NaN or infinity in the first {} frames{}", seen,
                                                     seen < k_frames ? ", stopped after 5 s" : "")};
}

Result<Answer> ask_mouse(ProbeBench& bench) {
    const Extent size = k_probe_extent;
    const int w = size.width, h = size.height;
    std::vector<FrameState> states;
    for (const glm::ivec2 pixel :
         {glm::ivec2(1, 1), glm::ivec2(w - 1, 1), glm::ivec2(1, h - 1), glm::ivec2(w - 1, h - 1),
          glm::ivec2(w / 2, 0), glm::ivec2(0, h / 2), glm::ivec2(w / 2, h - 1), glm::ivec2(w - 1, h / 2),
          glm::ivec2(w / 2, h / 2), glm::ivec2(-w, -h), glm::ivec2(2 * w, 2 * h)})
        for (const bool down : {false, true})
            states.push_back(with_mouse(render::Mouse::clicked(pixel, down)));
    const glm::ivec2 low(1, 1), high(w - 1, h - 1), outside(2 * w, -h);
    for (const auto& [from, to] :
         {std::pair(low, high), std::pair(high, low), std::pair(low, outside), std::pair(low, low)})
        for (const bool down : {false, true})
            states.push_back(with_mouse(render::Mouse::dragged(from, to, down)));
    return look_anew(bench, states);
}

Result<Answer> ask_sizes(ProbeBench& bench) {
    std::vector<FrameState> states;
    for (const Extent size : {Extent{1, 1}, Extent{1, 64}, Extent{64, 1}, Extent{63, 37},
                              Extent{gl::query_capabilities().largest_target, 1}})
        states.push_back(plain_state(size));
    return look_anew(bench, states);
}

Result<Answer> ask_knobs(ProbeBench& bench) {
    std::vector<FrameState> states;
    for (const scene::Knob& knob : bench.scene().knobs)
        if (knob.range)
            for (const scene::KnobValue& value : {knob.range->low, middle_of(knob), knob.range->high}) {
                states.push_back(plain_state());
                states.back().knobs = {scene::setting_of(knob, value)};
            }
    if (states.empty())
        return Answer{Verdict::not_applicable, "the scene has no knob with a range"};
    return look_anew(bench, states);
}

Result<Answer> ask_search(ProbeBench& bench) {
    auto plain = look_anew(bench, {});
    if (!plain || plain->verdict == Verdict::not_applicable)
        return plain;
    const auto explored = TRY(explore(bench));
    const std::string unread =
        (explored)->left_out.empty()
            ? ""
            : "; at random only, as the text cannot be analysed: " + (explored)->left_out;
    if ((explored)->not_finite.empty())
        return Answer{Verdict::pass, "no NaN or infinity; " + (explored)->sentence + unread};
    // The first of the most serious.
    const FrameState& where = *std::ranges::max_element(
        (explored)->not_finite, {}, [&](const FrameState& state) { return severity_in(bench, state); });
    const auto passes = TRY(bench.passes(where));
    auto fault = not_finite(bench, where, passes);
    if (!fault)
        return Answer{Verdict::note, "a pixel was NaN or infinite, but finite when drawn again", where};
    fault->sentence += "; " + (explored)->sentence + unread;
    return *std::move(fault);
}

// Looks for NaN and infinity with other pictures in the scene's input channels.

namespace {

/// A channel in which a pass reads a picture from a file or another outside source.
struct Input {
    std::string name;    ///< `iChannel0 of Buffer A`
    std::string setting; ///< `Buffer A:0` as in --channel; without the pass for Image
};

bool comes_from_outside(const scene::Scene& scene, const scene::ChannelInput& input) {
    return !source_pass(input) && scene::texture_kind(scene, input) == scene::TextureKind::flat;
}

/// Returns the inputs of all drawn passes whose channels the text mentions.
Result<std::vector<Input>> inputs_read(ProbeBench& bench) {
    const auto renderer = TRY(bench.compiled());
    const scene::Scene& scene = bench.scene();
    std::vector<Input> inputs;
    for (const render::PlannedPass& planned : (renderer)->plan().passes) {
        const scene::Pass& pass = scene.passes[planned.pass];
        const bool image = planned.pass == scene.image_index();
        const std::string text = scene.common.text() + pass.text.text();
        for (int channel = 0; channel < scene::k_channel_count; ++channel)
            if (comes_from_outside(scene, pass.channels[size_t(channel)].input) &&
                (text.find(fmt::format("iChannel{}", channel)) != text.npos ||
                 text.find(fmt::format("iCh{}", channel)) != text.npos))
                inputs.push_back(
                    {fmt::format("iChannel{}{}", channel, image ? "" : " of " + pass.name),
                     image ? std::to_string(channel) : fmt::format("{}:{}", pass.name, channel)});
    }
    return inputs;
}

/// Returns the percentage of pixels that a NaN in the input spreads to. Passing a NaN on is not a fault, but
/// useful to report.
Result<double> spread_of_nan(ProbeBench& bench, const Input& input) {
    FrameState state = plain_state();
    state.channels = {input.setting + "=nan"};
    const auto picture = TRY(bench.picture(state));
    const auto samples = picture.f32();
    size_t bad = 0;
    for (size_t pixel = 0; pixel < picture.extent.pixels(); ++pixel)
        bad += std::ranges::any_of(samples.subspan(3 * pixel, 3), [](float v) { return std::isnan(v); });
    return 100.0 * double(bad) / double(picture.extent.pixels());
}

} // namespace

Result<Answer> ask_inputs(ProbeBench& bench) {
    const auto inputs = TRY(inputs_read(bench));
    if (inputs.empty())
        return Answer{Verdict::not_applicable, "no pass reads a picture"};
    std::vector<FrameState> states;
    for (const Input& input : inputs)
        for (const char* what : {"none", "noise", "black", "white", "texel"}) {
            states.push_back(plain_state());
            states.back().channels = {fmt::format("{}={}", input.setting, what)};
        }
    auto answer = look_anew(bench, states);
    if (!answer || answer->verdict != Verdict::pass)
        return answer;
    for (const Input& input : inputs) {
        const auto spread = TRY(spread_of_nan(bench, input));
        answer->sentence += fmt::format("; NaN in {} spreads to {:.3g} % of the pixels", input.name, spread);
    }
    return answer;
}

// Proves that no NaN can arise, by value ranges of each pass over all pixels, a span of time and the knobs'
// ranges. Passes may read each other: if no pass makes a NaN from numbers, this holds for all frames.

namespace {

constexpr Extent k_usual_size{640, 360};

std::string range(const proof::Interval& interval) {
    if (interval.low < -1e30 && interval.high > 1e30)
        return "any number";
    return interval.low == interval.high ? fmt::format("{:.4g}", interval.low)
                                         : fmt::format("[{:.4g}, {:.4g}]", interval.low, interval.high);
}

/// Describes an operation and its operands.
std::string operation(const proof::Function& function, const proof::PartialOperation& what) {
    if (what.value == proof::k_no_value || what.operands.empty())
        return "a number that is infinite, or an input that may be NaN";
    const proof::Interval& a = what.operands[0];
    const proof::Interval& b = what.operands.back();
    switch (function.instructions[what.value].op) {
    case proof::Op::sqrt: return "sqrt of " + range(a);
    case proof::Op::inverse_sqrt: return "normalize or inversesqrt of a square in " + range(a);
    case proof::Op::divide: return "a division by " + range(b);
    case proof::Op::modulo: return "mod by " + range(b);
    case proof::Op::log:
    case proof::Op::log2: return "log of " + range(a);
    case proof::Op::pow: return fmt::format("pow of {} to {}", range(a), range(b));
    case proof::Op::asin:
    case proof::Op::acos: return "asin or acos of " + range(a);
    case proof::Op::atan2: return fmt::format("atan of {} and {}", range(a), range(b));
    case proof::Op::texel: return "a texture that is not analysed";
    default: return "an operation on " + range(a);
    }
}

/// Returns why the pass may make a NaN; empty if it cannot.
Result<std::string> doubt_of(const render::Renderer& renderer, size_t index, const FrameState& state,
                             double seconds) {
    const scene::Pass& pass = renderer.scene().passes[index];
    if (pass.kind == scene::PassKind::cubemap)
        return pass.name + " is a cubemap, which is not analysed";
    const auto function = PassFunction::create(renderer.scene(), pass);
    if (!function)
        return "the text cannot be analysed: " + function.error().message;
    const proof::ValueRanges ranges =
        ranges_of({*function, renderer, index, render::inputs_of(state)}, seconds);
    if (!ranges.settled)
        return pass.name + " has too deeply nested loops";
    for (const proof::Variable& variable : function->function().variables) {
        if (variable.kind != proof::Variable::Kind::output)
            continue;
        for (uint32_t cell = variable.first; cell < variable.first + std::min(variable.size, 4u); ++cell)
            if (const auto& doubt = ranges.partial[cell]) {
                const int line = doubt->value == proof::k_no_value
                                     ? 0
                                     : function->function().instructions[doubt->value].line;
                const SourceLocation where = function->locate(line);
                return fmt::format("{}:{}: {}", where.file, where.line,
                                   operation(function->function(), *doubt));
            }
    }
    return std::string();
}

bool is_finite_picture(const image::Image& picture) {
    return std::ranges::none_of(picture.f32(), [](float sample) { return std::isnan(sample); });
}

} // namespace

Result<Answer> ask_no_nan(ProbeBench& bench) {
    const FrameState state = state_at(1.0 / 3, k_usual_size);
    const double seconds = bench.promises().time_horizon;
    const render::Renderer& renderer = *TRY(bench.drawn(state));
    for (const render::PlannedPass& planned : renderer.plan().passes)
        if (const std::string doubt = TRY(doubt_of(renderer, planned.pass, state, seconds)); !doubt.empty())
            return Answer{Verdict::not_applicable, "NaN cannot be excluded: " + doubt};
    if (!is_finite_picture(renderer.read_back()))
        return Answer{Verdict::not_applicable, "a picture contradicts its proof: please report this scene"};
    return Answer{Verdict::pass,
                  fmt::format("no operation can leave its domain in any pixel of {}x{}, from 0 to {:g} s, at "
                              "any knob values; overflow of floats is not checked",
                              k_usual_size.width, k_usual_size.height, seconds)};
}

} // namespace tidemark::lab
