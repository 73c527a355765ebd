// What is found by reading the text alone.
#include "glsl/analysis/divergence.hpp"
#include "glsl/analysis/unassigned.hpp"
#include "lab/check/probe_text.hpp"
#include "lab/check/probes.hpp"
#include "scene/host_uniforms.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::lab {
namespace {

/// `neighbours may branch at a.glsl:3`, `called after the return at a.glsl:4`.
std::string to_text(const glsl::ParsedText& text, const glsl::DivergentBranch& branch) {
    const glsl::Node& at = text.tree()[branch.at];
    const std::string place = place_of(text, at.begin);
    const std::string_view called = branch.called ? "called " : "";
    if (!branch.exit)
        return fmt::format("{}{} {}", called,
                           branch.called ? "where neighbours may branch at" : "neighbours may branch at",
                           place);
    const bool by_call = at.kind == glsl::NodeKind::call;
    return fmt::format("{}after the {} at {}", called, by_call ? "discard in a call" : text.word(at.word),
                       place);
}

/// `sum (a.glsl:4)`, `hit (a.glsl:9, an `out` that some path does not write)`; empty: not the author's.
std::string to_text(const glsl::ParsedText& text, const glsl::Unassigned& each) {
    using Why = glsl::Unassigned::Why;
    const glsl::SyntaxTree& tree = text.tree();
    const bool declared = each.why == Why::not_given || each.why == Why::left_on_some_way;
    const std::string place = place_of(text, tree[declared ? each.what : each.at].word);
    if (place.empty())
        return {};
    const std::string_view how = each.why == Why::never         ? ""
                                 : each.why == Why::on_some_way ? ", on some path"
                                 : each.why == Why::not_given   ? ", an `out` that is never written"
                                 : each.why == Why::left_on_some_way
                                     ? ", an `out` that some path does not write"
                                     : ", on some path without a `return`";
    return fmt::format("{} ({}{})", text.word_of(each.what), place, how);
}

} // namespace

Result<Answer> ask_unassigned(ProbeBench& bench) {
    const auto texts = read_texts(bench, true);
    if (!texts)
        return Answer{Verdict::not_applicable, "the text cannot be followed: " + to_string(texts.error())};
    std::vector<std::string> found;
    for (const PassText& pass : *texts)
        for (const glsl::Unassigned& each : glsl::find_unassigned(*pass.text, pass.facts)) {
            std::string said = to_text(*pass.text, each);
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
        const scene::Channels& channels = bench.scene().passes[pass.pass].channels;
        const auto has_mipmaps = [&](std::string_view sampler) {
            const auto name = std::ranges::find(scene::k_channel_names, sampler);
            return name != scene::k_channel_names.end() &&
                   channels[size_t(name - scene::k_channel_names.begin())].sampling.mipmaps !=
                       scene::Mipmaps::none;
        };
        const glsl::ParsedText& text = *pass.text;
        for (const glsl::Divergent& each : glsl::find_divergent(text, pass.facts, has_mipmaps)) {
            const std::string place = place_of(text, text.tree()[each.call].begin);
            if (!place.empty())
                found.push_back(fmt::format("{} ({}, {})", glsl::called_name(text, each.call), place,
                                            to_text(text, each.branch)));
        }
    }
    if (found.empty())
        return Answer{Verdict::pass, "derivatives and mipmaps only in uniform control flow"};
    return Answer{Verdict::warn,
                  "needs neighbouring pixels, which may have taken another branch: " + listed(found)};
}

} // namespace tidemark::lab
