#include "lab/check/finite_look.hpp"

#include "base/try.hpp"
#include "image/census.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

/// A picture in grey with non-finite pixels in magenta, and the number of these.
struct Marked {
    image::Image map;
    size_t bad = 0; ///< pixels
};
Marked marked(const image::Image& picture) {
    Marked result{image::Image(picture.extent, 3, image::SampleType::f32)};
    const auto channels = size_t(picture.channels);
    for (size_t i = 0; i < picture.extent.pixels(); ++i) {
        const auto samples = picture.f32().subspan(i * channels, channels);
        const bool bad = std::ranges::any_of(samples, [](float v) { return !std::isfinite(v); });
        const float grey = bad ? 0.0f : std::clamp((samples[0] + samples[1] + samples[2]) / 3, 0.0f, 1.0f);
        const float shown[] = {bad ? 1.0f : grey, grey, bad ? 1.0f : grey};
        std::ranges::copy(shown, result.map.f32().begin() + std::ptrdiff_t(3 * i));
        result.bad += bad;
    }
    return result;
}

std::string kinds(const image::FiniteCensus& census) {
    std::string text;
    const std::pair<size_t, const char*> kinds[] = {
        {census.nan, "NaN"}, {census.positive_infinity, "+Inf"}, {census.negative_infinity, "-Inf"}};
    for (const auto& [count, name] : kinds)
        if (count > 0)
            text += fmt::format("{}{}", text.empty() ? "" : ", ", name);
    return text;
}

/// Returns nothing if the plain state is finite; otherwise the answer that refers to `times`, which reports
/// it.
Result<std::optional<Answer>> known_before(ProbeBench& bench) {
    const auto passes = TRY(bench.passes(plain_state()));
    if (not_finite(bench, plain_state(), passes))
        return Answer{Verdict::not_applicable, "NaN or infinity in the scene as it stands: see times"};
    return std::optional<Answer>{};
}

} // namespace

std::optional<Answer> not_finite(const ProbeBench& bench, const FrameState& state,
                                 const std::vector<PassPicture>& passes) {
    for (const PassPicture& pass : passes) {
        const image::FiniteCensus census = image::census(pass.picture);
        if (census.non_finite() == 0)
            continue;
        Marked shown = marked(pass.picture);
        Answer answer{Verdict::fail,
                      fmt::format("{} in {} of {} pixels of {}, first at pixel {},{}", kinds(census),
                                  shown.bad, pass.picture.extent.pixels(), pass.pass,
                                  census.first_non_finite->x, census.first_non_finite->y),
                      state, std::move(shown.map), true};
        answer.where->pass = pass.pass == bench.scene().image().name ? "" : pass.pass;
        return answer;
    }
    return std::nullopt;
}

Result<Answer> look(ProbeBench& bench, const std::vector<FrameState>& states) {
    Answer answer;
    size_t bad = 0, subnormal = 0, beyond_half = 0;
    for (const FrameState& state : states) {
        const auto passes = TRY(bench.passes(state));
        for (const PassPicture& pass : passes) {
            const image::FiniteCensus census = image::census(pass.picture);
            subnormal += census.subnormal > 0;
            beyond_half += census.beyond_half > 0;
        }
        auto fault = not_finite(bench, state, passes);
        bad += fault.has_value();
        if (fault && !answer.where)
            answer = *std::move(fault);
    }
    answer.sentence += bad > 0 ? fmt::format("; in {} of {} situations", bad, states.size())
                               : fmt::format("no NaN or infinity in {} situations", states.size());
    if (subnormal > 0)
        answer.sentence += fmt::format("; subnormal numbers in {}", subnormal);
    if (beyond_half > 0)
        answer.sentence += fmt::format("; numbers too large for half floats in {}", beyond_half);
    return answer;
}

Result<Answer> look_anew(ProbeBench& bench, const std::vector<FrameState>& states) {
    auto known = TRY(known_before(bench));
    return known ? *std::move(known) : look(bench, states);
}

} // namespace tidemark::lab
