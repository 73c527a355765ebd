#include "glsl/flow/float_counter.hpp"

#include "glsl/syntax/number.hpp"

#include <cmath>
#include <limits>
#include <optional>

namespace tidemark::glsl {
namespace {

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
    const NodeId head = tree.child(loop, 0), test = tree.child(loop, 1), change = tree.child(loop, 2);
    if (tree[head].kind != NodeKind::declaration || tree.child_count(head) != 2 ||
        type_name(text, tree.child(head, 0)) != "float" || tree[test].kind != NodeKind::binary ||
        tree[change].kind != NodeKind::assign)
        return std::nullopt;
    const NodeId declared = tree.child(head, 1);
    if (tree.child_count(declared) != 1 || is_bracket(text, tree.child(declared, 0)))
        return std::nullopt;
    FloatCounter counter{loop, text.word_of(declared), tree.child(declared, 0), tree.child(change, 1)};
    const std::string_view op = text.word_of(test), by = text.word_of(change);
    counter.down = by == "-=";
    const auto first = number_at(text, counter.first), last = number_at(text, tree.child(test, 1)),
               step = number_at(text, counter.step);
    const bool up = op == "<" || op == "<=";
    if (!is_name(text, tree.child(test, 0), counter.name) ||
        !is_name(text, tree.child(change, 0), counter.name) || (!up && op != ">" && op != ">=") ||
        (by != "+=" && by != "-=") || !first || !last || !step ||
        is_set_in(text, facts, tree.child(loop, 3), counter.name))
        return std::nullopt;
    numbers = {*first, *last, counter.down ? -*step : *step, op.ends_with('=')};
    return numbers.step != 0 && (numbers.step > 0) == up ? std::optional(counter) : std::nullopt;
}

} // namespace

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

} // namespace tidemark::glsl
