#include "glsl/flow/single_values.hpp"

namespace tidemark::glsl {

SingleValues::SingleValues(const ParsedText& text, const TreeFacts& facts) : text_(text) {
    const SyntaxTree& tree = text.tree();
    for (NodeId id = 1; id < tree.nodes.size(); ++id) {
        const NodeId function = tree.around(id, NodeKind::function);
        const NodeKind kind = tree[id].kind;
        if (kind == NodeKind::declarator || kind == NodeKind::parameter) {
            Declared& declared = declared_[{function, text.word_of(id)}];
            declared = {id, declared.times + 1};
        }
        for (const std::string_view name : names_set(text, facts, id)) {
            set_.insert({function, name});
            set_somewhere_.insert(name);
        }
    }
}

NodeId SingleValues::of(NodeId name) const {
    const SyntaxTree& tree = text_.tree();
    if (tree[name].kind != NodeKind::name)
        return k_no_node;
    const std::string_view word = text_.word_of(name);
    const Place local{tree.around(name, NodeKind::function), word};
    const auto inside = declared_.find(local), outside = declared_.find({k_no_node, word});
    const auto declared = inside != declared_.end() ? inside : outside;
    if (declared == declared_.end() || declared->second.times != 1 ||
        (declared == inside ? set_.contains(local) : set_somewhere_.contains(word)))
        return k_no_node;
    const NodeId node = declared->second.node;
    const bool has_value = tree[node].kind == NodeKind::declarator && tree.child_count(node) == 1 &&
                           !is_bracket(text_, tree.child(node, 0));
    return has_value ? tree.child(node, 0) : k_no_node;
}

} // namespace tidemark::glsl
