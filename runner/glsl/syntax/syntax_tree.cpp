#include "glsl/syntax/syntax_tree.hpp"

namespace tidemark::glsl {

std::vector<NodeId> SyntaxTree::children(NodeId id) const {
    std::vector<NodeId> ids;
    for (NodeId child = nodes[id].first_child; child != k_no_node; child = nodes[child].next)
        ids.push_back(child);
    return ids;
}

NodeId SyntaxTree::child(NodeId id, size_t index) const {
    NodeId child = nodes[id].first_child;
    while (index-- > 0 && child != k_no_node)
        child = nodes[child].next;
    return child;
}

size_t SyntaxTree::child_count(NodeId id) const {
    size_t count = 0;
    for (NodeId child = nodes[id].first_child; child != k_no_node; child = nodes[child].next)
        ++count;
    return count;
}

NodeId SyntaxTree::around(NodeId id, NodeKind kind) const {
    while (id != k_no_node && nodes[id].kind != kind)
        id = nodes[id].parent;
    return id;
}

bool SyntaxTree::is_within(NodeId id, NodeId ancestor) const {
    // Children are created before their parents, and their words lie within the parent's.
    return ancestor == 0 || (id <= ancestor && nodes[id].begin >= nodes[ancestor].begin &&
                             nodes[id].end <= nodes[ancestor].end);
}

bool is_expression(NodeKind kind) {
    return kind >= NodeKind::name && kind <= NodeKind::braces;
}

bool is_loop(NodeKind kind) {
    return kind == NodeKind::loop_for || kind == NodeKind::loop_while || kind == NodeKind::loop_do;
}

} // namespace tidemark::glsl
