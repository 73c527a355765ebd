#include "glsl/flow/loop_facts.hpp"

#include "glsl/syntax/number.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <algorithm>

namespace tidemark::glsl {
namespace {

constexpr int k_deepest_value = 20;

std::optional<double> combined(std::string_view op, double a, double b) {
    if (op == "+")
        return a + b;
    if (op == "-")
        return a - b;
    if (op == "*")
        return a * b;
    return std::nullopt;
}

/// Evaluates an expression of literals and constants.
std::optional<double> value_of(const ParsedText& text, const Shapes& shapes, NodeId id, int depth = 0) {
    const SyntaxTree& tree = text.tree();
    if (id == k_no_node || depth > k_deepest_value)
        return std::nullopt;
    const auto of = [&](size_t child) { return value_of(text, shapes, tree.child(id, child), depth + 1); };
    switch (tree[id].kind) {
    case NodeKind::literal: return number(text.word_of(id));
    case NodeKind::name: {
        const auto number = shapes.number(tree[id].begin, tree[id].end);
        return number ? std::optional(double(*number)) : std::nullopt;
    }
    case NodeKind::parenthesis: return of(0);
    case NodeKind::prefix: {
        const auto value = of(0);
        return value && text.word_of(id) == "-" ? std::optional(-*value) : std::nullopt;
    }
    case NodeKind::binary: {
        const auto a = of(0);
        const auto b = of(1);
        return a && b ? combined(text.word_of(id), *a, *b) : std::nullopt;
    }
    default: return std::nullopt;
    }
}

/// `i < N` of a loop that begins with `int i = A`.
struct Head {
    std::string_view counter;
    NodeId start = k_no_node;
    std::string_view comparison;
    NodeId bound = k_no_node;
};

std::optional<Head> head_of(const ParsedText& text, NodeId loop) {
    const SyntaxTree& tree = text.tree();
    Head head;
    NodeId first = tree.child(loop, 0);
    if (tree[first].kind == NodeKind::declaration && tree.child_count(first) == 2) {
        first = tree.child(first, 1);
        head.start = tree.child(first, 0);
        if (head.start == k_no_node || is_bracket(text, head.start))
            return std::nullopt;
    } else if (tree[first].kind == NodeKind::expression && tree.child_count(first) == 1) {
        first = tree.child(first, 0);
        if (tree[first].kind != NodeKind::assign || text.word_of(first) != "=" ||
            tree[tree.child(first, 0)].kind != NodeKind::name)
            return std::nullopt;
        head.start = tree.child(first, 1);
        first = tree.child(first, 0);
    } else {
        return std::nullopt;
    }
    head.counter = text.word_of(first);
    const NodeId condition = tree.child(loop, 1);
    const NodeId left = tree.child(condition, 0);
    if (tree[condition].kind != NodeKind::binary || tree[left].kind != NodeKind::name ||
        text.word_of(left) != head.counter)
        return std::nullopt;
    head.comparison = text.word_of(condition);
    head.bound = tree.child(condition, 1);
    return head;
}

/// Checks for `++i`, `i++`, `i += 1`.
bool counts_up(const ParsedText& text, NodeId step, std::string_view counter) {
    const SyntaxTree& tree = text.tree();
    const NodeId target = tree.child(step, 0);
    if (!is_change(text, step) || tree[target].kind != NodeKind::name || text.word_of(target) != counter)
        return false;
    if (tree[step].kind == NodeKind::assign)
        return text.word_of(step) == "+=" && text.word_of(tree.child(step, 1)) == "1";
    return text.word_of(step) == "++";
}

/// Checks that nothing in the body leaves an iteration early or may change the counter.
bool goes_straight(const ParsedText& text, const TreeFacts& facts, NodeId body, std::string_view counter) {
    const SyntaxTree& tree = text.tree();
    for (size_t i = tree[body].begin; i < tree[body].end; ++i)
        for (const std::string_view leaves : {"break", "continue", "return", "discard"})
            if (text.word(i) == leaves)
                return false;
    // children come before their parents
    for (NodeId id = body; id > 0 && tree[id].begin >= tree[body].begin; --id) {
        if (is_change(text, id) && text.word_of(tree.child(id, 0)) == counter)
            return false;
        if (tree[id].kind != NodeKind::call)
            continue;
        size_t index = 0;
        for (NodeId part = tree[tree.child(id, 0)].next; part != k_no_node; part = tree[part].next, ++index)
            if (text.word_of(part) == counter && facts.writes_argument(called_name(text, id), index))
                return false;
    }
    return true;
}

/// Returns the arguments that a call writes, if its function has exactly one definition.
std::vector<NodeId> surely_written(const ParsedText& text, const TreeFacts& facts, NodeId call) {
    const SyntaxTree& tree = text.tree();
    std::vector<NodeId> written;
    if (tree[call].kind != NodeKind::call)
        return written;
    const FunctionFacts* function = facts.function(called_name(text, call));
    if (!function || function->definitions.size() != 1)
        return written;
    size_t index = 0;
    for (NodeId part = tree[tree.child(call, 0)].next; part != k_no_node; part = tree[part].next, ++index)
        if (facts.writes_argument(called_name(text, call), index))
            written.push_back(part);
    return written;
}

} // namespace

bool is_always_true(const ParsedText& text, NodeId condition) {
    const NodeKind kind = text.tree()[condition].kind;
    return kind == NodeKind::absent || (kind == NodeKind::name && text.word_of(condition) == "true");
}

bool enters_surely(const ParsedText& text, const Shapes& shapes, NodeId loop) {
    const auto head = head_of(text, loop);
    if (!head)
        return false;
    const auto start = value_of(text, shapes, head->start);
    const auto bound = value_of(text, shapes, head->bound);
    if (!start || !bound)
        return false;
    const std::string_view is = head->comparison;
    return is == "<"    ? *start < *bound
           : is == "<=" ? *start <= *bound
           : is == ">"  ? *start > *bound
           : is == ">=" ? *start >= *bound
                        : is == "!=" && *start != *bound;
}

std::vector<NodeId> filled_arrays(const ParsedText& text, const TreeFacts& facts, NodeId loop) {
    const SyntaxTree& tree = text.tree();
    const auto head = head_of(text, loop);
    const NodeId body = tree.child(loop, 3);
    if (!head || text.word_of(head->start) != "0" || tree[head->start].kind != NodeKind::literal ||
        (head->comparison != "<" && head->comparison != "!=") ||
        !counts_up(text, tree.child(loop, 2), head->counter) ||
        !goes_straight(text, facts, body, head->counter))
        return {};
    std::vector<NodeId> arrays;
    std::vector<NodeId> statements{body};
    if (tree[body].kind == NodeKind::block)
        statements = tree.children(body);
    const auto add = [&](NodeId place) {
        if (tree[place].kind == NodeKind::index && tree[tree.child(place, 1)].kind == NodeKind::name &&
            text.word_of(tree.child(place, 1)) == head->counter)
            arrays.push_back(tree.child(place, 0));
    };
    for (const NodeId statement : statements) {
        if (tree[statement].kind != NodeKind::expression)
            continue;
        NodeId value = tree.child(statement, 0);
        if (tree[value].kind == NodeKind::assign && text.word_of(value) == "=") {
            add(tree.child(value, 0));
            value = tree.child(value, 1);
        }
        for (const NodeId argument : surely_written(text, facts, value))
            add(argument);
    }
    return arrays;
}

bool fills(const ParsedText& text, const Shapes& shapes, NodeId loop, NodeId declared, const Shape& shape,
           NodeId array) {
    const SyntaxTree& tree = text.tree();
    if (shape.kind != Shape::Kind::array && shape.kind != Shape::Kind::vector &&
        shape.kind != Shape::Kind::matrix)
        return false;
    const NodeId bound = head_of(text, loop)->bound;
    if (shape.length > 0) {
        const auto turns = value_of(text, shapes, bound);
        return turns && *turns >= double(shape.length);
    }
    // An array length that is not known here still matches a bound of the same name.
    const NodeId bracket = tree.child(declared, 0);
    if (tree[array].kind != NodeKind::name || tree.child_count(declared) != 1 || !is_bracket(text, bracket))
        return false;
    const Node& length = tree[tree.child(bracket, 0)];
    return length.kind == NodeKind::name && tree[bound].kind == NodeKind::name &&
           text.word(length.word) == text.word_of(bound);
}

} // namespace tidemark::glsl
