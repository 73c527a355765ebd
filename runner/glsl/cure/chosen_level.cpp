#include "glsl/cure/chosen_level.hpp"

#include <fmt/format.h>

namespace tidemark::glsl {

std::optional<WrittenTokens> look_up_by_neighbours(const ParsedText& text, const TreeFacts& facts,
                                                   NodeId id) {
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind != NodeKind::call || called_name(text, id) != "texture" || tree.child_count(id) < 3 ||
        tree[tree.child(id, 1)].kind != NodeKind::name || facts.function("texture"))
        return std::nullopt;
    const auto written = written_for(text, id, id);
    const bool whole =
        written && text.tokens()[written->first].is("texture") && text.tokens()[written->last].is(")");
    return whole ? written : std::nullopt;
}

std::optional<Cure> base_level(const ParsedText& text, const TreeFacts& facts, const Divergent& fault) {
    const SyntaxTree& tree = text.tree();
    const auto call = look_up_by_neighbours(text, facts, fault.call);
    if (!call)
        return std::nullopt;
    Cure cure{{in_place_of(text, {call->first, call->first}, "textureLod")},
              fmt::format("takes the base level in `{}`, whatever neighbouring pixels do",
                          text.excerpt(fault.call))};
    const NodeId bias = tree.child(fault.call, 3);
    if (bias == k_no_node) {
        cure.wraps.push_back(wrapped(text, {call->last, call->last}, ", 0.0", ""));
        return cure;
    }
    const auto words = written_for(text, bias, fault.call);
    if (!words || words->first <= call->first || words->last >= call->last)
        return std::nullopt;
    cure.wraps.push_back(in_place_of(text, *words, "0.0"));
    return cure;
}

} // namespace tidemark::glsl
