#include "glsl/analysis/float_operation.hpp"

namespace tidemark::glsl {
namespace {

bool is_arithmetic(std::string_view op) {
    return op == "+" || op == "-" || op == "*" || op == "/";
}

/// Returns whether evaluating the node twice has no side effect.
bool is_pure(const SyntaxTree& tree, NodeId id) {
    switch (tree[id].kind) {
    case NodeKind::call:
    case NodeKind::assign:
    case NodeKind::postfix:
    case NodeKind::prefix: return false; // ++ and --; other prefixes appear only in a target's index
    default: break;
    }
    for (NodeId child = tree[id].first_child; child != k_no_node; child = tree[child].next)
        if (!is_pure(tree, child))
            return false;
    return true;
}

} // namespace

bool is_float_operation(const ParsedText& text, const TreeFacts& facts, NodeId id) {
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

} // namespace tidemark::glsl
