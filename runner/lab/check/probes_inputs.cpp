// Looks for NaN and infinity with other pictures in the scene's input channels.
#include "base/try.hpp"
#include "image/census.hpp"
#include "lab/check/finite_look.hpp"
#include "lab/check/probes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
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

} // namespace tidemark::lab
