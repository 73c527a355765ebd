#include "glsl/watch/watch.hpp"

namespace tidemark::glsl {
namespace {

bool is_arithmetic(std::string_view op) {
    return op == "+" || op == "-" || op == "*" || op == "/";
}

/// Evaluating it twice does nothing twice.
bool is_pure(const SyntaxTree& tree, NodeId id) {
    switch (tree[id].kind) {
    case NodeKind::call:
    case NodeKind::assign:
    case NodeKind::postfix: return false;
    case NodeKind::prefix: return false; // ++ and --; others stand in no target but its index
    default: break;
    }
    for (NodeId child = tree[id].first_child; child != k_no_node; child = tree[child].next)
        if (!is_pure(tree, child))
            return false;
    return true;
}

} // namespace

bool is_watched_operation(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    const SyntaxTree& tree = text.tree();
    switch (tree[id].kind) {
    case NodeKind::binary: return is_arithmetic(text.word_of(id)) && !facts.surely_whole[id];
    case NodeKind::assign: {
        const std::string_view op = text.word_of(id);
        const NodeId target = tree.child(id, 0);
        return op.size() == 2 && is_arithmetic(op.substr(0, 1)) && !facts.surely_whole[target] &&
               is_pure(tree, target);
    }
    case NodeKind::call: {
        const std::string_view name = called_name(text, id);
        if (name.empty() || facts.is_type(name))
            return false;
        const FunctionFacts* function = facts.function(name);
        if (function)
            return !function->returns_nothing && !function->returns_array;
        return !name.ends_with("Extended") && name != "barrier" && !name.starts_with("memoryBarrier") &&
               !name.starts_with("image") && !name.starts_with("textureSize") && !name.starts_with("atomic");
    }
    default: return false;
    }
}

std::vector<NodeId> uninitialised(const ParsedText& text, const TreeFacts& facts) {
    const SyntaxTree& tree = text.tree();
    std::vector<NodeId> found;
    const auto known = [&](NodeId type) {
        const std::string_view name = type_name(text, type);
        const TypeClass kind = class_of_type(name);
        return kind == TypeClass::floating || kind == TypeClass::whole || facts.structures.contains(name);
    };
    for (NodeId id = 1; id < tree.nodes.size(); ++id) {
        const Node& node = tree[id];
        if (node.kind == NodeKind::parameter) {
            const NodeId type = tree.child(id, 0);
            const NodeId function = node.parent;
            const bool defined = tree[tree.nodes[function].first_child].next != k_no_node &&
                                 text.word(tree[function].end - 1) == "}";
            if (defined && has_qualifier(text, type, "out") && known(type))
                found.push_back(id);
        } else if (node.kind == NodeKind::declarator && tree[node.parent].kind == NodeKind::declaration) {
            const NodeId type = tree.child(node.parent, 0);
            const NodeKind around = tree[tree[node.parent].parent].kind;
            bool has_value = false;
            for (const NodeId part : tree.children(id))
                has_value = has_value || !is_bracket(text, part);
            const bool variable = around == NodeKind::block || around == NodeKind::text;
            if (variable && !has_value && !is_given(text, type) && known(type))
                found.push_back(id);
        }
    }
    return found;
}

} // namespace tidemark::glsl
