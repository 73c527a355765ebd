// Checks for what GLSL leaves undefined: functions outside their domain, whose values differ between GPUs,
// and indices, shifts, divisions, fetches and conversions out of bounds.
#include "base/try.hpp"
#include "lab/check/exploration.hpp"
#include "lab/check/probes.hpp"
#include "lab/check/undefined_calls.hpp"

#include <fmt/format.h>

namespace tidemark::lab {

Result<Answer> ask_undefined(ProbeBench& bench) {
    const auto where = TRY(usual_views(bench));
    const auto texts = read_texts(bench, false);
    if (!texts)
        return Answer{Verdict::not_applicable, "the text cannot be followed: " + to_string(texts.error())};
    auto found = find_undefined(bench, *texts, where);
    if (!found)
        return Answer{Verdict::not_applicable, to_string(found.error())};
    std::vector<UndefinedCall>& all = *found;
    std::vector<std::string> sentences;
    for (const UndefinedCall& each : all)
        if (each.percent > 0)
            sentences.push_back(fmt::format("{}: {:.3g} % of the pixels", each.sentence, each.percent));
    if (sentences.empty())
        return Answer{
            Verdict::pass,
            all.empty()
                ? "no function is called outside of its domain"
                : fmt::format("{} calls outside of a function's domain, none of which changes a pixel",
                              all.size())};
    return Answer{Verdict::warn, "undefined, and visible in the picture: " + listed(sentences), all[0].where,
                  std::move(all[0].picture)};
}

Result<Answer> ask_bounds(ProbeBench& bench) {
    const auto explored = TRY(explore(bench));
    if (!(explored)->left_out.empty())
        return Answer{Verdict::not_applicable, "the text cannot be followed: " + (explored)->left_out};
    std::vector<std::string> sentences;
    std::optional<FrameState> where;
    for (const Outside& outside : (explored)->outside)
        if (outside.bound) {
            sentences.push_back(outside.sentence);
            where = where ? where : outside.where;
        }
    if (sentences.empty())
        return Answer{Verdict::pass, "no index, shift, divisor, texel or conversion is out of bounds; " +
                                         (explored)->sentence};
    return Answer{Verdict::warn, listed(sentences), where};
}

} // namespace tidemark::lab
