#include "glsl/cure/hoisted_derivative.hpp"

#include "glsl/syntax/expression_type.hpp"

#include <fmt/format.h>

#include <set>
#include <string_view>

namespace tidemark::glsl {
namespace {

/// Returns the statement of the function's body that holds the node; k_no_node: none does.
NodeId outermost_statement(const SyntaxTree& tree, NodeId id) {
    while (id != k_no_node && tree[tree[tree[id].parent].parent].kind != NodeKind::function)
        id = tree[id].parent;
    return id != k_no_node && tree[tree[id].parent].kind == NodeKind::block ? id : k_no_node;
}

/// Returns whether a name in `expression` is declared or set between the two statements, both included.
bool changes_between(const ParsedText& text, const TreeFacts& facts, NodeId expression, NodeId first,
                     NodeId last) {
    const SyntaxTree& tree = text.tree();
    std::set<std::string_view> used;
    for (NodeId id = 1; id <= expression; ++id) // parts come before the node that holds them
        if (tree[id].kind == NodeKind::name && tree.is_within(id, expression))
            used.insert(text.word_of(id));
    for (NodeId id = 1; id <= last; ++id) {
        if (tree[id].begin < tree[first].begin || tree[id].end > tree[last].end)
            continue;
        if (tree[id].kind == NodeKind::declarator && used.contains(text.word_of(id)))
            return true;
        for (const std::string_view set : names_set(text, facts, id))
            if (used.contains(set))
                return true;
    }
    return false;
}

} // namespace

std::optional<Cure> hoisted_derivative(const ParsedText& text, const TreeFacts& facts,
                                       const Divergent& fault) {
    const SyntaxTree& tree = text.tree();
    const NodeId first = outermost_statement(tree, fault.branch.at),
                 last = outermost_statement(tree, fault.call);
    const bool in_one_function =
        tree.around(first, NodeKind::function) == tree.around(last, NodeKind::function);
    if (fault.branch.called || first == k_no_node || last == k_no_node || !in_one_function ||
        changes_between(text, facts, fault.call, first, last))
        return std::nullopt;
    const auto type = expression_type(text, facts, fault.call);
    const auto written = written_for(text, fault.call, fault.call);
    const auto words = written ? said_again(text, facts, fault.call, *written) : std::nullopt;
    const Word& front = text.words()[tree[first].begin];
    if (!type || !words || front.from_macro() || text.words()[tree[fault.call].word].from_macro())
        return std::nullopt;
    const std::string name = fresh_name(text, "taken_before");
    return Cure{{wrapped(text, {front.spelled, front.spelled},
                         fmt::format("{} {} = {}; ", to_string(*type), name, *words), ""),
                 in_place_of(text, *written, name)},
                fmt::format("takes `{}` in front of where neighbouring pixels diverge", *words)};
}

} // namespace tidemark::glsl
