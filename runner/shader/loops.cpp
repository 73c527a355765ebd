#include "shader/loops.hpp"

#include "shader/tree_facts.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
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

std::optional<double> value_of_literal(const ParsedText& text, NodeId literal) {
    return literal == k_no_node ? std::nullopt : number(text.word_of(literal));
}

std::optional<double> literal(const ParsedText& text, NodeId id) {
    return id == k_no_node ? std::nullopt : value_of_literal(text, literal_node(text, id));
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

/// Returns whether the expression has its operand's value before the change: `i++`.
bool changes_after_test(const ParsedText& text, NodeId change) {
    return text.tree()[change].kind == NodeKind::postfix;
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
        const auto first = first_of(text, loop, name), last = value_of_literal(text, number);
        if (*change != 1 || !first || !last)
            return LoopBound{};
        const double distance = *last - *first;
        const double passed = op == "<=" || op == ">=" ? std::floor(distance) + 1 : std::ceil(distance);
        const bool runs_first = tree[loop].kind == NodeKind::loop_do;
        const bool before_test = !named && !changes_after_test(text, counter); // `++i < 64`
        return LoopBound{number, *first, std::max(0.0, passed - before_test) + runs_first};
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

/// Returns the comparison inside a condition that counts; k_no_node if there is none.
NodeId counter_test_in(const ParsedText& text, NodeId condition, NodeId loop) {
    const SyntaxTree& tree = text.tree();
    if (tree[condition].kind == NodeKind::parenthesis)
        return counter_test_in(text, tree.child(condition, 0), loop);
    if (tree[condition].kind != NodeKind::binary)
        return k_no_node;
    if (text.word_of(condition) != "&&")
        return bound_by(text, condition, loop) ? condition : k_no_node;
    const NodeId left = counter_test_in(text, tree.child(condition, 0), loop);
    return left != k_no_node ? left : counter_test_in(text, tree.child(condition, 1), loop);
}

/// Loops with more iterations are not simulated; drivers cancel them earlier.
constexpr double k_most_turns = 1e6;
/// Tolerance for a quotient of two literals, for the rounding in double: within it the quotient is a whole
/// number.
constexpr double k_rounding = 1e-9;

/// Returns the value of a number literal with an optional minus sign.
std::optional<double> number_at(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    id = without_brackets(tree, id);
    const bool negative = tree[id].kind == NodeKind::prefix && text.word_of(id) == "-";
    const NodeId literal = negative ? tree.child(id, 0) : id;
    const auto value = tree[literal].kind == NodeKind::literal ? number(text.word_of(literal)) : std::nullopt;
    return value && negative ? std::optional(-*value) : value;
}

bool is_name(const ParsedText& text, NodeId id, std::string_view name) {
    return text.tree()[id].kind == NodeKind::name && text.word_of(id) == name;
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

struct Numbers {
    double first = 0, last = 0, step = 0; ///< negative if the loop counts down
    bool with_last = false;               ///< `<=`
};

double float_turns(const Numbers& numbers) {
    const auto last = float(numbers.last), step = float(numbers.step);
    auto at = float(numbers.first);
    double turns = 0;
    const auto goes_on = [&] { return step > 0 ? at < last : at > last; };
    while ((goes_on() || (numbers.with_last && at == last)) && turns <= k_most_turns) {
        const float next = at + step;
        if (next == at)
            return std::numeric_limits<double>::infinity();
        at = next;
        ++turns;
    }
    return turns;
}

double exact_turns(const Numbers& numbers) {
    const double quotient = (numbers.last - numbers.first) / numbers.step;
    const double whole = std::nearbyint(quotient);
    if (std::abs(quotient - whole) <= k_rounding * std::max(1.0, std::abs(whole)))
        return std::max(0.0, whole + numbers.with_last);
    return std::max(0.0, std::ceil(quotient));
}

bool is_set_in(const ParsedText& text, const TreeFacts& facts, NodeId body, std::string_view name) {
    for (NodeId id = 1; id < body; ++id) // children come before their parents
        if (text.tree().is_within(id, body))
            for (const std::string_view set : names_set(text, facts, id))
                if (set == name)
                    return true;
    return false;
}

/// Returns nothing for a loop of another form.
std::optional<FloatCounter> counter_of(const ParsedText& text, const TreeFacts& facts, NodeId loop,
                                       Numbers& numbers) {
    const SyntaxTree& tree = text.tree();
    const auto head = head_of(text, loop);
    const NodeId declaration = tree.child(loop, 0), change = tree.child(loop, 2);
    if (!head || tree[declaration].kind != NodeKind::declaration ||
        type_name(text, tree.child(declaration, 0)) != "float" || tree[change].kind != NodeKind::assign)
        return std::nullopt;
    FloatCounter counter{loop, head->counter, head->start, tree.child(change, 1)};
    const std::string_view op = head->comparison, by = text.word_of(change);
    counter.down = by == "-=";
    const auto first = number_at(text, counter.first), last = number_at(text, head->bound),
               step = number_at(text, counter.step);
    const bool up = op == "<" || op == "<=";
    if (!is_name(text, tree.child(change, 0), counter.name) || (!up && op != ">" && op != ">=") ||
        (by != "+=" && by != "-=") || !first || !last || !step ||
        is_set_in(text, facts, tree.child(loop, 3), counter.name))
        return std::nullopt;
    numbers = {*first, *last, counter.down ? -*step : *step, op.ends_with('=')};
    return numbers.step != 0 && (numbers.step > 0) == up ? std::optional(counter) : std::nullopt;
}

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
    return !is_set_in(text, facts, body, counter);
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

NodeId loop_condition(const ParsedText& text, NodeId loop) {
    const SyntaxTree& tree = text.tree();
    const size_t index = tree[loop].kind == NodeKind::loop_while ? 0 : 1;
    const NodeId condition = tree.child(loop, index);
    return condition != k_no_node && tree[condition].kind == NodeKind::absent ? k_no_node : condition;
}

NodeId counter_test(const ParsedText& text, NodeId loop) {
    const NodeId condition = loop_condition(text, loop);
    return condition == k_no_node ? k_no_node : counter_test_in(text, condition, loop);
}

std::optional<LoopBound> loop_bound(const ParsedText& text, NodeId loop) {
    const NodeId condition = loop_condition(text, loop);
    if (condition == k_no_node)
        return std::nullopt;
    return bound_in(text, condition, loop);
}

std::vector<FloatCounter> miscounting_loops(const ParsedText& text, const TreeFacts& facts) {
    const SyntaxTree& tree = text.tree();
    std::vector<FloatCounter> found;
    for (NodeId id = 1; id < tree.nodes.size(); ++id) {
        Numbers numbers;
        auto counter = tree[id].kind == NodeKind::loop_for && tree.child_count(id) == 4
                           ? counter_of(text, facts, id, numbers)
                           : std::nullopt;
        if (!counter)
            continue;
        counter->turns = float_turns(numbers);
        counter->exact_turns = exact_turns(numbers);
        if (counter->turns != counter->exact_turns && counter->exact_turns <= k_most_turns)
            found.push_back(*counter);
    }
    return found;
}

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

NodeId body_of_loop(const SyntaxTree& tree, NodeId loop) {
    return tree.child(loop, tree[loop].kind == NodeKind::loop_do ? 0 : tree.child_count(loop) - 1);
}

namespace {

class LeftLoops {
public:
    LeftLoops(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts), globals_(globals_set(text, facts)) {}

    std::vector<LeftLoop> run() {
        std::vector<LeftLoop> loops;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            if (is_loop(tree_[id].kind) && tree_.around(id, NodeKind::function) != k_no_node)
                if (LeftLoop loop = look_at(id); !loop.variables.empty())
                    loops.push_back(std::move(loop));
        return loops;
    }

private:
    LeftLoop look_at(NodeId loop) {
        LeftLoop found;
        found.body = body_of_loop(tree_, loop);
        std::set<std::string_view> names, own;
        bool left = false;
        for (NodeId id = loop - 1; id != k_no_node && tree_.is_within(id, loop); --id) {
            add_names_set(text_, facts_, globals_, id, names);
            if (tree_[id].kind == NodeKind::declarator)
                own.insert(text_.word_of(id));
            if (tree_[id].kind == NodeKind::jump && statement_left_by(id) == loop) {
                left = left || text_.word_of(id) == "break";
                if (text_.word_of(id) == "continue")
                    found.continues.push_back(id);
            }
            left = left || tree_[id].kind == NodeKind::return_statement;
        }
        for (const std::string_view name : names)
            if (left && !own.contains(name) && !name.starts_with("gl_"))
                for (const LeftLoop::Variable& part : parts_of(name))
                    found.variables.push_back(part);
        return found;
    }

    /// Returns the variable, or the numbers and vectors of a structure.
    const std::vector<LeftLoop::Variable>& parts_of(std::string_view name) {
        const auto [found, is_new] = parts_.try_emplace(name);
        if (!is_new)
            return found->second;
        if (const auto type = type_of(name))
            found->second.push_back({std::string(name), *type});
        else if (const auto structure = facts_.structures.find(structure_of(name));
                 structure != facts_.structures.end())
            for (const StructureMember& member : structure->second)
                if (const auto own = value_type(member.type); own && !own->matrix() && !member.array)
                    found->second.push_back({fmt::format("{}.{}", name, member.name), *own});
        return found->second;
    }

    /// Returns the structure that all variables of that name are; empty: there is none.
    std::string_view structure_of(std::string_view variable) const {
        std::string_view found;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            const bool is_parameter = tree_[id].kind == NodeKind::parameter;
            if ((!is_parameter && tree_[id].kind != NodeKind::declarator) || text_.word_of(id) != variable)
                continue;
            const NodeId type = tree_.child(is_parameter ? id : tree_[id].parent, 0);
            const std::string_view name = type_name(text_, type);
            if (dimensions(text_, type, id) > 0 || (!found.empty() && name != found))
                return {};
            found = name;
        }
        return found;
    }

    /// Returns the loop, or for `break` the `switch`, that the statement is about.
    NodeId statement_left_by(NodeId jump) const {
        NodeId id = tree_[jump].parent;
        while (id != k_no_node && !is_loop(tree_[id].kind) &&
               (tree_[id].kind != NodeKind::switch_on || text_.word_of(jump) != "break"))
            id = tree_[id].parent;
        return id;
    }

    /// Returns nothing for a name that has several types, or another than a number's or a vector's.
    std::optional<ValueType> type_of(std::string_view variable) const {
        std::optional<ValueType> type;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            if (tree_[id].kind != NodeKind::name || text_.word_of(id) != variable)
                continue;
            const auto own = expression_type(text_, facts_, id);
            if (!own || own->matrix() || (type && *type != *own))
                return std::nullopt;
            type = own;
        }
        return type;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    NamesSet globals_;
    std::map<std::string_view, std::vector<LeftLoop::Variable>> parts_;
};

} // namespace

std::vector<LeftLoop> left_loops(const ParsedText& text, const TreeFacts& facts) {
    return LeftLoops(text, facts).run();
}

} // namespace tidemark::glsl
