// What pictures a scene can be given.
#include "image/census.hpp"
#include "lab/check/finite_look.hpp"
#include "lab/check/probes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

/// The channels from which Image reads pictures.
std::vector<int> read_channels(const ProbeBench& bench) {
    const scene::Scene& scene = bench.scene();
    const std::string text = scene.common.text() + scene.image().text.text();
    std::vector<int> channels;
    for (int channel = 0; channel < scene::k_channel_count; ++channel) {
        const auto kind = scene::texture_kind(scene, scene.image().channels[size_t(channel)].input);
        if (kind == scene::TextureKind::flat && text.find(fmt::format("iChannel{}", channel)) != text.npos)
            channels.push_back(channel);
    }
    return channels;
}

/// A NaN that comes in may go out: no fault, but good to know. Of the pixels, in percent.
Result<double> spread_of_nan(ProbeBench& bench, int channel) {
    const auto picture = bench.picture({.channels = {fmt::format("{}=nan", channel)}});
    if (!picture)
        return fail(picture.error());
    const auto samples = picture->f32();
    size_t bad = 0;
    for (size_t pixel = 0; pixel < picture->extent.pixels(); ++pixel)
        bad += std::ranges::any_of(samples.subspan(3 * pixel, 3), [](float v) { return std::isnan(v); });
    return 100.0 * double(bad) / double(picture->extent.pixels());
}

} // namespace

Result<Answer> ask_inputs(ProbeBench& bench) {
    const std::vector<int> channels = read_channels(bench);
    if (channels.empty())
        return Answer{Verdict::not_applicable, "Image reads no picture"};
    std::vector<Situation> situations;
    for (const int channel : channels)
        for (const char* what : {"none", "noise", "black", "white", "texel"})
            situations.push_back({.channels = {fmt::format("{}={}", channel, what)}});
    auto answer = look_anew(bench, situations);
    if (!answer || answer->verdict != Verdict::pass)
        return answer;
    for (const int channel : channels) {
        const auto spread = spread_of_nan(bench, channel);
        if (!spread)
            return fail(spread.error());
        answer->sentence +=
            fmt::format("; NaN in iChannel{} comes to {:.3g} % of the pixels", channel, *spread);
    }
    return answer;
}

} // namespace tidemark::lab
