#include "glsl/flow/loop_bound.hpp"

#include "glsl/syntax/number.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tidemark::glsl {
namespace {

/// Returns the literal that an expression is, in parentheses or by the name of a constant that is declared
/// once.
NodeId literal_node(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    id = without_brackets(tree, id);
    if (tree[id].kind != NodeKind::name)
        return tree[id].kind == NodeKind::literal ? id : k_no_node;
    NodeId found = k_no_node;
    for (NodeId each = 1; each < tree.nodes.size(); ++each) {
        if (tree[each].kind != NodeKind::declarator || text.word_of(each) != text.word_of(id))
            continue;
        const NodeId value = tree.child(each, 0);
        const bool constant = has_qualifier(text, tree.child(tree[each].parent, 0), "const");
        if (found != k_no_node || !constant || value == k_no_node || tree[value].kind != NodeKind::literal)
            return k_no_node;
        found = value;
    }
    return found;
}

std::optional<double> number_of(const ParsedText& text, NodeId literal) {
    return literal == k_no_node ? std::nullopt : number(text.word_of(literal));
}

std::optional<double> literal(const ParsedText& text, NodeId id) {
    return id == k_no_node ? std::nullopt : number_of(text, literal_node(text, id));
}

/// Returns the start value from the head of a `for`; 0 if the head has none.
std::optional<double> first_of(const ParsedText& text, NodeId loop, std::string_view counter) {
    const SyntaxTree& tree = text.tree();
    if (tree[loop].kind != NodeKind::loop_for)
        return 0;
    const NodeId head = tree.child(loop, 0);
    for (NodeId id = head; id > k_no_node && tree[id].begin >= tree[head].begin; --id) {
        const bool declared = tree[id].kind == NodeKind::declarator && text.word_of(id) == counter;
        const bool assigned = tree[id].kind == NodeKind::assign && text.word_of(id) == "=" &&
                              text.word_of(tree.child(id, 0)) == counter;
        if (declared && tree.child_count(id) == 0)
            return 0;
        if (declared || assigned)
            return literal(text, tree.child(id, declared ? 0 : 1));
    }
    return 0;
}

/// Returns the variable that `++i`, `i++` or `i += 2` changes; empty for any other expression.
std::string_view changed_name(const ParsedText& text, NodeId id) {
    const NodeId target = text.tree().child(id, 0);
    const bool names = is_change(text, id) && text.tree()[target].kind == NodeKind::name;
    return names ? text.word_of(target) : std::string_view();
}

/// Returns by how much an expression changes a variable in each iteration; nothing if it does not, or if the
/// amount is unknown.
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

/// Returns k_no_node if there is no step.
NodeId step_of(const SyntaxTree& tree, NodeId loop) {
    return tree[loop].kind == NodeKind::loop_for ? tree.child(loop, 2) : k_no_node;
}

/// Returns the bound that one comparison in a loop's head sets.
std::optional<LoopBound> bound_by(const ParsedText& text, NodeId test, NodeId loop) {
    const SyntaxTree& tree = text.tree();
    const NodeId left = tree.child(test, 0), right = tree.child(test, 1);
    const std::string_view op = text.word_of(test);
    const bool less = op == "<" || op == "<=" || op == "!=";
    if (!less && op != ">" && op != ">=")
        return std::nullopt;
    // `64 > i` means `i < 64`.
    for (const auto& [counter, bound, up] : {std::tuple(left, right, less), std::tuple(right, left, !less)}) {
        const bool named = tree[counter].kind == NodeKind::name;
        const std::string_view name = named ? text.word_of(counter) : changed_name(text, counter);
        const auto change =
            name.empty() ? std::nullopt : change_of(text, named ? step_of(tree, loop) : counter, name);
        if (!change || *change == 0 || (*change > 0) != (up || op == "!="))
            continue;
        const NodeId number = literal_node(text, bound);
        const auto first = first_of(text, loop, name), last = number_of(text, number);
        if (*change != 1 || !first || !last)
            return LoopBound{};
        return LoopBound{number, *first,
                         std::max(0.0, std::ceil(*last - *first) + (op == "<=" || op == ">="))};
    }
    return std::nullopt;
}

/// One false side of `&&` is enough to end a loop.
std::optional<LoopBound> bound_in(const ParsedText& text, NodeId condition, NodeId loop) {
    const SyntaxTree& tree = text.tree();
    if (tree[condition].kind == NodeKind::parenthesis)
        return bound_in(text, tree.child(condition, 0), loop);
    if (tree[condition].kind != NodeKind::binary)
        return std::nullopt;
    if (text.word_of(condition) != "&&")
        return bound_by(text, condition, loop);
    const auto left = bound_in(text, tree.child(condition, 0), loop);
    return left ? left : bound_in(text, tree.child(condition, 1), loop);
}

} // namespace

NodeId loop_condition(const ParsedText& text, NodeId loop) {
    const SyntaxTree& tree = text.tree();
    const size_t index = tree[loop].kind == NodeKind::loop_while ? 0 : 1;
    const NodeId condition = tree.child(loop, index);
    return condition != k_no_node && tree[condition].kind == NodeKind::absent ? k_no_node : condition;
}

std::optional<LoopBound> loop_bound(const ParsedText& text, NodeId loop) {
    const NodeId condition = loop_condition(text, loop);
    if (condition == k_no_node)
        return std::nullopt;
    return bound_in(text, condition, loop);
}

} // namespace tidemark::glsl
