#include "glsl/cut/loop_bound.hpp"

#include "glsl/syntax/tree_facts.hpp"

#include <charconv>

namespace tidemark::glsl {
namespace {

NodeId without_brackets(const SyntaxTree& tree, NodeId id) {
    while (tree[id].kind == NodeKind::parenthesis)
        id = tree.child(id, 0);
    return id;
}

std::optional<double> literal(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    id = without_brackets(tree, id);
    if (tree[id].kind != NodeKind::literal)
        return std::nullopt;
    const std::string_view digits = text.word_of(id);
    double value = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return read.ec == std::errc{} ? std::optional(value) : std::nullopt;
}

/// The variable that `++i`, `i++`, `i += 2` change; empty for any other expression.
std::string_view changed_name(const ParsedText& text, NodeId id) {
    const NodeId target = text.tree().child(id, 0);
    const bool names = is_change(text, id) && text.tree()[target].kind == NodeKind::name;
    return names ? text.word_of(target) : std::string_view();
}

/// By how much an expression changes a variable in each turn; nothing: it does not, or nobody knows.
std::optional<double> change_of(const ParsedText& text, NodeId id, std::string_view name) {
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind == NodeKind::comma) {
        const auto first = change_of(text, tree.child(id, 0), name);
        return first ? first : change_of(text, tree.child(id, 1), name);
    }
    if (changed_name(text, id) != name)
        return std::nullopt;
    const std::string_view op = text.word_of(id);
    if (op == "++" || op == "--")
        return op == "++" ? 1 : -1;
    const auto by = literal(text, tree.child(id, 1));
    return by && op == "+=" ? by : by && op == "-=" ? std::optional(-*by) : std::nullopt;
}

/// Of one comparison in the head of a loop.
std::optional<LoopBound> bound_by(const ParsedText& text, NodeId test, NodeId step) {
    const SyntaxTree& tree = text.tree();
    const NodeId left = tree.child(test, 0), right = tree.child(test, 1);
    std::string_view op = text.word_of(test);
    const bool less = op == "<" || op == "<=" || op == "!=";
    if (!less && op != ">" && op != ">=")
        return std::nullopt;
    // `64 > i` is `i < 64`.
    for (const auto& [counter, number, up] :
         {std::tuple(left, right, less), std::tuple(right, left, !less)}) {
        const bool named = tree[counter].kind == NodeKind::name;
        const std::string_view name = named ? text.word_of(counter) : changed_name(text, counter);
        const auto change = name.empty() ? std::nullopt : change_of(text, named ? step : counter, name);
        if (!change || *change == 0 || (*change > 0) != (up || op == "!="))
            continue;
        if (*change < 0)
            return LoopBound{};
        const auto most = *change == 1 ? literal(text, number) : std::nullopt;
        return LoopBound{*change == 1 ? without_brackets(tree, number) : k_no_node, most};
    }
    return std::nullopt;
}

/// Any side of `&&` is enough to end a loop.
std::optional<LoopBound> bound_in(const ParsedText& text, NodeId condition, NodeId step) {
    const SyntaxTree& tree = text.tree();
    if (tree[condition].kind == NodeKind::parenthesis)
        return bound_in(text, tree.child(condition, 0), step);
    if (tree[condition].kind != NodeKind::binary)
        return std::nullopt;
    if (text.word_of(condition) != "&&")
        return bound_by(text, condition, step);
    const auto left = bound_in(text, tree.child(condition, 0), step);
    return left ? left : bound_in(text, tree.child(condition, 1), step);
}

} // namespace

NodeId loop_condition(const ParsedText& text, NodeId loop) {
    const SyntaxTree& tree = text.tree();
    const size_t index = tree[loop].kind == NodeKind::loop_while ? 0 : 1;
    const NodeId condition = tree.child(loop, index);
    return condition != k_no_node && tree[condition].kind == NodeKind::absent ? k_no_node : condition;
}

std::optional<LoopBound> loop_bound(const ParsedText& text, NodeId loop) {
    const SyntaxTree& tree = text.tree();
    const NodeId condition = loop_condition(text, loop);
    if (condition == k_no_node)
        return std::nullopt;
    return bound_in(text, condition, tree[loop].kind == NodeKind::loop_for ? tree.child(loop, 2) : k_no_node);
}

} // namespace tidemark::glsl
