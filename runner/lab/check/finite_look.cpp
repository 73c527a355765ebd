#include "lab/check/finite_look.hpp"

#include "image/census.hpp"

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

} // namespace

Result<Answer> look(ProbeBench& bench, const std::vector<Situation>& situations) {
    Answer answer;
    size_t bad = 0, subnormal = 0, beyond_half = 0;
    for (const Situation& situation : situations) {
        const auto passes = bench.passes(situation);
        if (!passes)
            return fail(passes.error());
        bool seen = false;
        for (const PassPicture& pass : *passes) {
            const image::FiniteCensus census = image::census(pass.picture);
            subnormal += census.subnormal > 0;
            beyond_half += census.beyond_half > 0;
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
    answer.sentence += bad > 0 ? fmt::format("; in {} of {} situations", bad, situations.size())
                               : fmt::format("all numbers finite in {} situations", situations.size());
    if (subnormal > 0)
        answer.sentence += fmt::format("; subnormal ones in {}", subnormal);
    if (beyond_half > 0)
        answer.sentence += fmt::format("; beyond the range of halves in {}", beyond_half);
    return answer;
}

Result<Answer> look_anew(ProbeBench& bench, const std::vector<Situation>& situations) {
    auto known = known_before(bench);
    if (!known)
        return fail(std::move(known.error()));
    return *known ? **std::move(known) : look(bench, situations);
}

} // namespace tidemark::lab
