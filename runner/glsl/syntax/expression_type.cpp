#include "glsl/syntax/expression_type.hpp"

#include "glsl/syntax/builtin_functions.hpp"

#include <vector>

namespace tidemark::glsl {
namespace {

class Typer {
public:
    Typer(const ParsedText& text, const TreeFacts& facts) : text_(text), tree_(text.tree()), facts_(facts) {}

    std::optional<ValueType> of(NodeId id) const {
        switch (tree_[id].kind) {
        case NodeKind::literal: return type_of_literal(text_.word_of(id));
        case NodeKind::name: return of_name(id);
        case NodeKind::parenthesis:
        case NodeKind::prefix:
        case NodeKind::postfix: return of(tree_.child(id, 0));
        case NodeKind::conditional: return of(tree_.child(id, 1));
        case NodeKind::binary: {
            const auto left = of(tree_.child(id, 0)), right = of(tree_.child(id, 1));
            return left && right ? type_of_operation(text_.word_of(id), *left, *right) : std::nullopt;
        }
        case NodeKind::member: {
            const auto whole = of(tree_.child(id, 0));
            return whole ? type_of_member(*whole, text_.word_of(id)) : std::nullopt;
        }
        case NodeKind::call: return of_call(id);
        default: return std::nullopt;
        }
    }

private:
    std::optional<ValueType> of_name(NodeId id) const {
        const NodeId function = tree_.around(id, NodeKind::function);
        NodeId local = k_no_node, global = k_no_node;
        for (NodeId each = 1; each < tree_.nodes.size(); ++each) {
            const NodeKind kind = tree_[each].kind;
            if ((kind != NodeKind::declarator && kind != NodeKind::parameter) ||
                text_.word_of(each) != text_.word_of(id) ||
                tree_.around(each, NodeKind::structure) != k_no_node)
                continue;
            const NodeId inside = tree_.around(each, NodeKind::function);
            if (inside != function && inside != k_no_node)
                continue;
            NodeId& found = inside == k_no_node ? global : local;
            if (found != k_no_node)
                return std::nullopt;
            found = each;
        }
        const NodeId declared = local != k_no_node ? local : global;
        if (declared == k_no_node)
            return std::nullopt;
        const NodeId type =
            tree_.child(tree_[declared].kind == NodeKind::parameter ? declared : tree_[declared].parent, 0);
        return dimensions(text_, type, declared) == 0 ? value_type(type_name(text_, type)) : std::nullopt;
    }

    std::optional<ValueType> of_call(NodeId id) const {
        const std::string_view name = called_name(text_, id);
        if (const FunctionFacts* const own = facts_.function(name))
            return of_own(*own);
        if (const auto constructed = value_type(name))
            return constructed;
        const BuiltinFunction* const builtin = find_builtin(name);
        if (!builtin)
            return std::nullopt;
        if (builtin->is(Trait::implicit_lod))
            return value_type("vec4");
        std::vector<ValueType> arguments;
        for (size_t i = 1; i < tree_.child_count(id); ++i) {
            const auto argument = of(tree_.child(id, i));
            if (!argument)
                return std::nullopt;
            arguments.push_back(*argument);
        }
        return type_of_call(*builtin, arguments);
    }

    /// Returns the common type of all overloads; nothing if they differ.
    std::optional<ValueType> of_own(const FunctionFacts& function) const {
        std::optional<ValueType> type;
        for (const NodeId definition : function.definitions) {
            const auto each = value_type(type_name(text_, tree_.child(definition, 0)));
            if (!each || (type && *type != *each))
                return std::nullopt;
            type = each;
        }
        return type;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
};

} // namespace

std::optional<ValueType> expression_type(const ParsedText& text, const TreeFacts& facts, NodeId expression) {
    return Typer(text, facts).of(expression);
}

} // namespace tidemark::glsl
