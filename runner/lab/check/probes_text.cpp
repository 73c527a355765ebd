// Probes that only read the text.
#include "glsl/analysis/divergence.hpp"
#include "glsl/analysis/unassigned.hpp"
#include "lab/check/probe_text.hpp"
#include "lab/check/probes.hpp"
#include "lab/check/text_words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::lab {
Result<Answer> ask_unassigned(ProbeBench& bench) {
    const auto texts = read_texts(bench, true);
    if (!texts)
        return Answer{Verdict::not_applicable, "the text cannot be followed: " + to_string(texts.error())};
    std::vector<std::string> found;
    for (const PassText& pass : *texts)
        for (const glsl::Unassigned& each : glsl::find_unassigned(*pass.text, pass.facts)) {
            std::string said = sentence_for(*pass.text, each);
            if (!said.empty() && std::ranges::find(found, said) == found.end())
                found.push_back(std::move(said));
        }
    const std::string_view looked =
        "every path through the functions that run was followed, whatever the conditions";
    if (found.empty())
        return Answer{Verdict::pass, fmt::format("nothing is read without a value: {}", looked)};
    return Answer{Verdict::warn, fmt::format("without a value, which is 0 on ShaderToy's site and here, and "
                                             "anything elsewhere: {}; {}",
                                             listed(found), looked)};
}

Result<Answer> ask_divergence(ProbeBench& bench) {
    const auto texts = read_texts(bench, true);
    if (!texts)
        return Answer{Verdict::not_applicable, "the text cannot be followed: " + to_string(texts.error())};
    std::vector<std::string> found;
    for (const PassText& pass : *texts) {
        const glsl::ParsedText& text = *pass.text;
        for (const glsl::Divergent& each :
             glsl::find_divergent(text, pass.facts, which_have_mipmaps(bench.scene().passes[pass.pass]))) {
            const std::string place = place_of(text, text.tree()[each.call].begin);
            if (!place.empty())
                found.push_back(fmt::format("{} ({}, {})", glsl::called_name(text, each.call), place,
                                            words_for(text, each.branch)));
        }
    }
    if (found.empty())
        return Answer{Verdict::pass, "derivatives and mipmaps only in uniform control flow"};
    return Answer{Verdict::warn,
                  "needs neighbouring pixels, which may have taken another branch: " + listed(found)};
}

Result<Answer> ask_counters(ProbeBench& bench) {
    const auto texts = read_texts(bench, true);
    if (!texts)
        return Answer{Verdict::not_applicable, "the text cannot be followed: " + to_string(texts.error())};
    std::vector<std::string> found;
    for (const PassText& pass : *texts)
        for (const glsl::FloatCounter& each : glsl::miscounting_loops(*pass.text, pass.facts)) {
            const std::string place = place_of(*pass.text, pass.text->tree()[each.loop].begin);
            std::string said = fmt::format("{}: {}", place, words_for(each));
            if (!place.empty() && std::ranges::find(found, said) == found.end())
                found.push_back(std::move(said));
        }
    if (found.empty())
        return Answer{Verdict::pass,
                      "no loop counts in floats to another number of turns than its numbers make"};
    return Answer{Verdict::warn, listed(found)};
}

} // namespace tidemark::lab
