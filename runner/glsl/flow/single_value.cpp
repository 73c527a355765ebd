#include "glsl/flow/single_value.hpp"

namespace tidemark::glsl {
namespace {

/// A declarator or parameter of that name in `function`, k_no_node: outside of all; `count` of them.
struct Declared {
    NodeId node = k_no_node;
    int count = 0;
};

Declared declared_in(const ParsedText& text, NodeId function, std::string_view name) {
    const SyntaxTree& tree = text.tree();
    Declared found;
    for (NodeId id = 1; id < tree.nodes.size(); ++id) {
        const NodeKind kind = tree[id].kind;
        if ((kind == NodeKind::declarator || kind == NodeKind::parameter) && text.word_of(id) == name &&
            tree.around(id, NodeKind::function) == function)
            found = {id, found.count + 1};
    }
    return found;
}

} // namespace

NodeId single_value(const ParsedText& text, const TreeFacts& facts, NodeId name) {
    const SyntaxTree& tree = text.tree();
    if (tree[name].kind != NodeKind::name)
        return k_no_node;
    const std::string_view word = text.word_of(name);
    const NodeId function = tree.around(name, NodeKind::function);
    Declared declared = declared_in(text, function, word);
    const bool local = declared.count > 0;
    if (!local)
        declared = declared_in(text, k_no_node, word);
    if (declared.count != 1 || tree[declared.node].kind != NodeKind::declarator ||
        tree.child_count(declared.node) != 1 || is_bracket(text, tree.child(declared.node, 0)))
        return k_no_node;
    for (NodeId id = 1; id < tree.nodes.size(); ++id)
        if ((!local || tree.around(id, NodeKind::function) == function) && sets(text, facts, id, word))
            return k_no_node;
    return tree.child(declared.node, 0);
}

} // namespace tidemark::glsl
