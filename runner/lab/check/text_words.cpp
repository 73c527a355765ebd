#include "lab/check/text_words.hpp"

#include "lab/check/probe_text.hpp"
#include "scene/host_uniforms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {

std::string_view words_for(glsl::Unassigned::Why why) {
    using Why = glsl::Unassigned::Why;
    return why == Why::never              ? ""
           : why == Why::on_some_way      ? ", on some path"
           : why == Why::not_given        ? ", an `out` that is never written"
           : why == Why::left_on_some_way ? ", an `out` that some path does not write"
                                          : ", on some path without a `return`";
}

size_t word_without_value(const glsl::ParsedText& text, const glsl::Unassigned& each) {
    using Why = glsl::Unassigned::Why;
    const bool declared = each.why == Why::not_given || each.why == Why::left_on_some_way;
    return text.tree()[declared ? each.what : each.at].word;
}

std::string sentence_for(const glsl::ParsedText& text, const glsl::Unassigned& each) {
    const std::string place = place_of(text, word_without_value(text, each));
    if (place.empty())
        return {};
    return fmt::format("{} ({}{})", text.word_of(each.what), place, words_for(each.why));
}

std::string words_for(const glsl::ParsedText& text, const glsl::DivergentBranch& branch) {
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

std::string words_for(const glsl::ParsedText& text, const glsl::Divergent& each) {
    return fmt::format("{} needs neighbouring pixels, which may have taken another branch: {}",
                       glsl::called_name(text, each.call), words_for(text, each.branch));
}

std::string words_for(const glsl::FloatCounter& counter) {
    if (std::isinf(counter.turns))
        return fmt::format(
            "{} stands still after some turns, for a step is less than its rounding: the loop has "
            "no end",
            counter.name);
    return fmt::format("{} counts {} turns, where its numbers make {}: each step is rounded", counter.name,
                       counter.turns, counter.exact_turns);
}

std::function<bool(std::string_view)> which_have_mipmaps(const scene::Pass& pass) {
    return [&channels = pass.channels](std::string_view sampler) {
        const auto name = std::ranges::find(scene::k_channel_names, sampler);
        return name != scene::k_channel_names.end() &&
               channels[size_t(name - scene::k_channel_names.begin())].sampling.mipmaps !=
                   scene::Mipmaps::none;
    };
}

} // namespace tidemark::lab
