// Non-finite numbers: drawn in many situations, counted by bits on the CPU.
#include "gl/capabilities.hpp"
#include "image/census.hpp"
#include "lab/probes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

/// The picture in grey, pixels that are no number magenta.
image::Image marked(const image::Image& picture) {
    image::Image map(picture.extent, 3, image::SampleType::f32);
    const auto channels = size_t(picture.channels);
    for (size_t i = 0; i < picture.extent.pixels(); ++i) {
        const auto samples = picture.f32().subspan(i * channels, channels);
        const bool bad = std::ranges::any_of(samples, [](float v) { return !std::isfinite(v); });
        const float grey = bad ? 0.0f : std::clamp((samples[0] + samples[1] + samples[2]) / 3, 0.0f, 1.0f);
        const float shown[] = {bad ? 1.0f : grey, grey, bad ? 1.0f : grey};
        std::ranges::copy(shown, map.f32().begin() + std::ptrdiff_t(3 * i));
    }
    return map;
}

std::string counts(const image::FiniteCensus& census) {
    std::string text;
    const std::pair<size_t, const char*> kinds[] = {
        {census.nan, "NaN"}, {census.positive_infinity, "+Inf"}, {census.negative_infinity, "-Inf"}};
    for (const auto& [count, name] : kinds)
        if (count > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
    return text;
}

/// Nothing when the scene as it stands is finite; otherwise what `times` has said already.
Result<std::optional<Answer>> known_before(ProbeBench& bench) {
    const auto passes = bench.passes({});
    if (!passes)
        return fail(passes.error());
    for (const PassPicture& pass : *passes)
        if (image::census(pass.picture).non_finite() > 0)
            return Answer{Verdict::not_applicable, "not finite as the scene stands: see times", {}, {}};
    return std::nullopt;
}

/// Asks the same of every situation; the first bad one is told.
Result<Answer> look(ProbeBench& bench, const std::vector<Situation>& situations) {
    Answer answer;
    size_t bad = 0, subnormal = 0;
    for (const Situation& situation : situations) {
        const auto passes = bench.passes(situation);
        if (!passes)
            return fail(passes.error());
        bool seen = false;
        for (const PassPicture& pass : *passes) {
            const image::FiniteCensus census = image::census(pass.picture);
            subnormal += census.subnormal > 0;
            if (census.non_finite() == 0)
                continue;
            if (!answer.where) {
                const image::SamplePlace& at = *census.first_non_finite;
                answer = {Verdict::fail,
                          fmt::format("{} of {} samples of {} ({}), first at pixel {},{}",
                                      census.non_finite(), census.samples, pass.pass, counts(census), at.x,
                                      at.y),
                          situation, marked(pass.picture), true};
                answer.where->pass = pass.pass == bench.scene().image().name ? "" : pass.pass;
            }
            seen = true;
        }
        bad += seen;
    }
    if (bad > 0)
        answer.sentence += fmt::format("; in {} of {} situations", bad, situations.size());
    else
        answer.sentence = fmt::format("all numbers finite in {} situations", situations.size()) +
                          (subnormal > 0 ? fmt::format("; subnormal ones in {}", subnormal) : "");
    return answer;
}

/// As `look`, of situations that are new only where the plain one is clean.
Result<Answer> look_anew(ProbeBench& bench, const std::vector<Situation>& situations) {
    auto known = known_before(bench);
    if (!known)
        return fail(std::move(known.error()));
    return *known ? **std::move(known) : look(bench, situations);
}

std::string middle_of(const scene::Knob& knob) {
    scene::KnobValue value{};
    for (size_t i = 0; i < value.size(); ++i) {
        value[i] = (knob.range->low[i] + knob.range->high[i]) / 2;
        if (scene::info(knob.type).whole)
            value[i] = std::floor(value[i]);
    }
    return scene::to_string(knob, value);
}

} // namespace

Result<Answer> ask_times(ProbeBench& bench) {
    std::vector<Situation> situations;
    for (const double time :
         {0.0, 1e-6, 1.0, 60.0, 62.83 - 1 / 60.0, 62.83 + 1 / 60.0, 1e3, 1e4, 1e5, 1e6, 16777216.0, -5.0})
        situations.push_back({.time = time});
    return look(bench, situations);
}

Result<Answer> ask_mouse(ProbeBench& bench) {
    const Extent size = Situation().extent;
    const int w = size.width, h = size.height;
    std::vector<Situation> situations;
    for (const glm::ivec2 pixel : {glm::ivec2(1, 1), glm::ivec2(w - 1, 1), glm::ivec2(1, h - 1),
                                   glm::ivec2(w - 1, h - 1), glm::ivec2(w / 2, 0), glm::ivec2(0, h / 2),
                                   glm::ivec2(w / 2, h / 2), glm::ivec2(-w, -h), glm::ivec2(2 * w, 2 * h)})
        for (const bool down : {false, true})
            situations.push_back({.mouse = pixel, .down = down});
    return look_anew(bench, situations);
}

Result<Answer> ask_sizes(ProbeBench& bench) {
    std::vector<Situation> situations;
    for (const Extent size : {Extent{1, 1}, Extent{1, 64}, Extent{64, 1}, Extent{63, 37},
                              Extent{gl::query_capabilities().largest_target, 1}})
        situations.push_back({.extent = size});
    return look_anew(bench, situations);
}

Result<Answer> ask_inputs(ProbeBench& bench) {
    std::vector<Situation> situations;
    for (int channel = 0; channel < scene::k_channel_count; ++channel) {
        const scene::Pass& image = bench.scene().image();
        const std::string name = fmt::format("iChannel{}", channel);
        const bool read = (bench.scene().common.text() + image.text.text()).find(name) != std::string::npos;
        const auto kind = scene::texture_kind(bench.scene(), image.channels[size_t(channel)].input);
        if (!read || kind != scene::TextureKind::flat)
            continue;
        for (const char* what : {"none", "noise"})
            situations.push_back({.channels = {fmt::format("{}={}", channel, what)}});
    }
    if (situations.empty())
        return Answer{Verdict::not_applicable, "Image reads no picture", {}, {}};
    return look_anew(bench, situations);
}

Result<Answer> ask_knobs(ProbeBench& bench) {
    std::vector<Situation> situations;
    for (const scene::Knob& knob : bench.scene().knobs)
        if (knob.range)
            for (const std::string& value : {scene::to_string(knob, knob.range->low), middle_of(knob),
                                             scene::to_string(knob, knob.range->high)})
                situations.push_back({.settings = {{knob.name, value}}});
    if (situations.empty())
        return Answer{Verdict::not_applicable, "the scene has no knob with a range"};
    return look_anew(bench, situations);
}

} // namespace tidemark::lab
