// Cures of loops, and an instrument that records how they end.
#include "base/encoding.hpp"
#include "shader/fixes.hpp"
#include "shader/loops.hpp"
#include "shader/source_edits.hpp"
#include "shader/tree_facts.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <unordered_map>
#include <utility>

namespace tidemark::glsl {
namespace {

/// Writes the value with the type of the digits that it replaces.
std::string number_like(std::string_view digits, double value) {
    std::string text = fmt::format("{}", value);
    if (digits.find_first_of(".eE") != digits.npos)
        return float_literal(text);
    return digits.ends_with('u') ? text + "u" : text;
}

} // namespace

std::optional<Wrap> with_turns(const ParsedText& text, const LoopBound& bound, double turns) {
    const auto written =
        bound.number == k_no_node ? std::nullopt : written_for(text, bound.number, bound.number);
    if (!written)
        return std::nullopt;
    return in_place_of(text, *written, number_like(text.word_of(bound.number), bound.first + turns));
}

std::optional<Cure> whole_counter(const ParsedText& text, const FloatCounter& counter) {
    const SyntaxTree& tree = text.tree();
    const NodeId head = tree.child(counter.loop, 0), step = tree.child(counter.loop, 2),
                 body = tree.child(counter.loop, 3);
    const auto from = written_for(text, head, head), to = written_for(text, step, step),
               inside = written_for(text, body, body);
    if (!from || !to || !inside)
        return std::nullopt;
    const std::string turn = fresh_name(text, fmt::format("{}_turn", counter.name));
    Cure cure;
    cure.wraps.push_back(
        in_place_of(text, {from->first, to->last},
                    fmt::format("int {0} = 0; {0} < {1}; ++{0}", turn, counter.exact_turns)));
    cure.wraps.push_back(
        wrapped(text, *inside,
                fmt::format("{{ float {} = {} {} {} * float({}); ", counter.name, text.excerpt(counter.first),
                            counter.down ? "-" : "+", text.excerpt(counter.step), turn),
                " }"));
    cure.reason = fmt::format("counts in integers: {} iterations, as written", counter.exact_turns);
    return cure;
}

namespace {

constexpr std::array k_more{2.0, 4.0, 8.0};
constexpr std::array k_shorter{0.8, 0.6, 0.4, 0.25, 0.1};
constexpr std::array k_larger{4.0, 16.0, 64.0, 256.0};
/// Larger literals are not taken for a threshold.
constexpr double k_largest_threshold = 0.1;

bool is_on(const ParsedText& text, size_t word, const SourceLocation& line) {
    for (const SourceLocation& where : {text.used(word), text.spelled(word)})
        if (where.file == line.file && where.line == line.line)
            return true;
    return false;
}

bool holds(const ParsedText& text, NodeId id, const SourceLocation& line) {
    for (size_t word = text.tree()[id].begin; word < text.tree()[id].end; ++word)
        if (is_on(text, word, line))
            return true;
    return false;
}

/// Returns the innermost loop that has both the test and the step; k_no_node: none.
NodeId find_loop(const ParsedText& text, const MarchPlace& place) {
    const SyntaxTree& tree = text.tree();
    const auto fits = [&](NodeId id) {
        return is_loop(tree[id].kind) && holds(text, id, place.test) &&
               std::ranges::all_of(place.updates, [&](const auto& line) { return holds(text, id, line); });
    };
    for (NodeId id = 1; id < tree.nodes.size(); ++id) // inner loops come first
        if (fits(id))
            return id;
    return k_no_node;
}

/// Returns the added expression of `t += d` and of `t = t + d`.
NodeId added_in(const ParsedText& text, NodeId assignment) {
    const SyntaxTree& tree = text.tree();
    if (tree[assignment].kind != NodeKind::assign)
        return k_no_node;
    const NodeId target = tree.child(assignment, 0), value = tree.child(assignment, 1);
    if (text.word_of(assignment) == "+=")
        return value;
    const bool sum = text.word_of(assignment) == "=" && tree[value].kind == NodeKind::binary &&
                     text.word_of(value) == "+" && text.excerpt(tree.child(value, 0)) == text.excerpt(target);
    return sum ? tree.child(value, 1) : k_no_node;
}

/// Returns the steps of a march; empty unless each update line has exactly one.
std::vector<NodeId> find_steps(const ParsedText& text, NodeId loop, const MarchPlace& place) {
    const SyntaxTree& tree = text.tree();
    std::vector<NodeId> steps;
    for (const SourceLocation& line : place.updates) {
        std::vector<NodeId> here;
        for (NodeId id = 1; id < loop; ++id) {
            const NodeId added = tree.is_within(id, loop) ? added_in(text, id) : k_no_node;
            if (added != k_no_node && tree[added].kind != NodeKind::literal &&
                is_on(text, tree[id].word, line))
                here.push_back(added);
        }
        if (here.size() != 1)
            return {};
        if (std::ranges::find(steps, here.front()) == steps.end())
            steps.push_back(here.front());
    }
    return steps;
}

/// Multiplies the iterations by `factor`; nothing if the loop has no literal bound.
std::optional<Cure> turned_more(const ParsedText& text, NodeId loop, double factor) {
    const auto bound = loop == k_no_node ? std::nullopt : loop_bound(text, loop);
    const double turns = bound ? std::ceil(factor * bound->turns) : 0;
    auto wrap = bound ? with_turns(text, *bound, turns) : std::nullopt;
    if (!wrap)
        return std::nullopt;
    return Cure{{*std::move(wrap)}, fmt::format("{:g} iterations instead of {:g}", turns, bound->turns)};
}

/// Returns the only literal of a product; k_no_node: there is none, or there are several.
NodeId literal_in(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    id = without_brackets(tree, id);
    if (tree[id].kind != NodeKind::binary || text.word_of(id) != "*")
        return tree[id].kind == NodeKind::literal ? id : k_no_node;
    const NodeId left = literal_in(text, tree.child(id, 0)), right = literal_in(text, tree.child(id, 1));
    return left == k_no_node ? right : right == k_no_node ? left : k_no_node;
}

/// Returns the literal of an operand, or of a name's value, if it is small enough for a threshold.
NodeId small_literal(const ParsedText& text, const SingleValues& values, NodeId id) {
    const NodeId value = values.of(without_brackets(text.tree(), id));
    const NodeId literal = literal_in(text, value == k_no_node ? id : value);
    const auto size = literal == k_no_node ? std::nullopt : number(text.word_of(literal));
    return size && *size > 0 && *size <= k_largest_threshold ? literal : k_no_node;
}

/// Returns the threshold of the distance test; k_no_node if its line is ambiguous.
NodeId threshold_of(const ParsedText& text, const TreeFacts& facts, NodeId loop, const SourceLocation& line) {
    const SyntaxTree& tree = text.tree();
    const SingleValues values(text, facts);
    NodeId found = k_no_node;
    for (NodeId id = 1; id < loop; ++id) {
        const std::string_view op = text.word_of(id);
        const bool compares = op == "<" || op == "<=" || op == ">" || op == ">=";
        if (tree[id].kind != NodeKind::binary || !compares || !tree.is_within(id, loop) ||
            !is_on(text, tree[id].word, line))
            continue;
        const NodeId left = small_literal(text, values, tree.child(id, 0)),
                     right = small_literal(text, values, tree.child(id, 1));
        if ((left == k_no_node) == (right == k_no_node))
            continue;
        if (found != k_no_node)
            return k_no_node;
        found = left == k_no_node ? right : left;
    }
    return found;
}

} // namespace

std::vector<Cure> more_turns(const ParsedText& text, MarchPlace place) {
    place.updates.clear();
    const NodeId loop = find_loop(text, place);
    std::vector<Cure> cures;
    for (const double factor : k_more)
        if (auto cure = turned_more(text, loop, factor)) {
            cure->reason += ": rays that ended before a hit go on";
            cures.push_back(*std::move(cure));
        }
    return cures;
}

std::vector<Cure> shorter_steps(const ParsedText& text, const MarchPlace& place, double longest) {
    const NodeId loop = find_loop(text, place);
    const std::vector<NodeId> steps =
        loop == k_no_node ? std::vector<NodeId>() : find_steps(text, loop, place);
    std::vector<Cure> cures;
    for (const double factor : k_shorter) {
        if (factor > longest)
            continue;
        Cure cure{{}, fmt::format("steps of {:g} of the distance", factor)};
        for (const NodeId step : steps)
            if (const auto written = written_for(text, step, step))
                cure.wraps.push_back(wrapped(text, *written, fmt::format("{:g} * (", factor), ")"));
        if (cure.wraps.empty() || cure.wraps.size() < steps.size())
            break;
        if (auto more = turned_more(text, loop, 1 / factor)) {
            cure.reason += ", and " + more->reason;
            std::ranges::move(more->wraps, std::back_inserter(cure.wraps));
        }
        cures.push_back(std::move(cure));
    }
    return cures;
}

std::vector<Cure> larger_threshold(const ParsedText& text, const TreeFacts& facts, const MarchPlace& place) {
    const NodeId loop = find_loop(text, place);
    const NodeId literal = loop == k_no_node ? loop : threshold_of(text, facts, loop, place.test);
    const auto written = literal == k_no_node ? std::nullopt : written_for(text, literal, literal);
    if (!written)
        return {};
    const double now = *number(text.word_of(literal));
    std::vector<Cure> cures;
    for (const double factor : k_larger)
        if (const double larger = factor * now; larger <= k_largest_threshold)
            cures.push_back(
                {{in_place_of(text, *written, float_literal(fmt::format("{:.3g}", larger)))},
                 fmt::format(
                     "hit threshold {:.3g} instead of {:.3g}: rounding keeps the distance from becoming less",
                     larger, now)});
    return cures;
}

namespace {

/// Adds up the iterations of the loops that a function runs, with those of the functions that it calls.
class Iterations {
public:
    Iterations(const ParsedText& text, const TreeFacts& facts) : text_(text), facts_(facts) {}

    double of_function(std::string_view name) {
        const FunctionFacts* const function = facts_.function(name);
        if (!function)
            return 0;
        const auto [known, is_new] = known_.try_emplace(name, 0.0); // 0 also ends a recursion
        if (!is_new)
            return known->second;
        double most = 0;
        for (const NodeId definition : function->definitions)
            most = std::max(most, of(definition));
        return known_[name] = most;
    }

private:
    double of(NodeId id) {
        const SyntaxTree& tree = text_.tree();
        double inside = 0;
        for (const NodeId child : tree.children(id))
            inside += of(child);
        if (tree[id].kind == NodeKind::call)
            return inside + of_function(called_name(text_, id));
        if (!is_loop(tree[id].kind))
            return inside;
        const auto bound = loop_bound(text_, id);
        const bool known = bound && bound->number != k_no_node;
        return known ? bound->turns * (1 + inside) : std::numeric_limits<double>::infinity();
    }

    const ParsedText& text_;
    const TreeFacts& facts_;
    std::unordered_map<std::string_view, double> known_;
};

/// A pixel has run at least so many iterations if the driver's limit ends a loop. Some drivers also unroll a
/// loop of floats with an iteration less than its sums make, which is no limit.
constexpr int k_fewest_of_a_limit = 32'767;

/// `@` is the number of loops.
constexpr std::string_view k_ends_prelude = R"(layout(std430,binding=0) buffer $Buffer{uint $out[];};
bool $open[@];
int $turns=0;
bool $counts(int i,bool goes_on){if(!goes_on)$out[2*i+1]=1u;return goes_on;}
)";

class EndRecorder {
public:
    EndRecorder(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts), prefix_(fresh_prefix(text)), edits_(text) {}

    LoopEnds run() {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            if (is_loop(tree_[id].kind))
                result_.loops.push_back(id);
        if (result_.loops.empty())
            return std::move(result_);
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) // inner nodes come before outer ones
            visit(id);
        result_.text = headers_with_buffers(text_) +
                       spell(k_ends_prelude, prefix_, fmt::format("{}", result_.loops.size())) +
                       edits_.text();
        return std::move(result_);
    }

private:
    size_t index_of(NodeId loop) const {
        return size_t(std::ranges::find(result_.loops, loop) - result_.loops.begin());
    }

    /// Returns the loop that a `break` or `return` leaves; k_no_node for that of a switch or outside loops.
    NodeId left_by(NodeId jump) const {
        const bool leaves_function = tree_[jump].kind == NodeKind::return_statement;
        for (NodeId id = tree_[jump].parent; id != k_no_node; id = tree_[id].parent) {
            if (is_loop(tree_[id].kind))
                return id;
            if (tree_[id].kind == NodeKind::function ||
                (tree_[id].kind == NodeKind::switch_on && !leaves_function))
                return k_no_node;
        }
        return k_no_node;
    }

    /// Returns whether an `if` between the jump and its loop tests an integer variable.
    bool tests_a_count(NodeId jump, NodeId loop) const {
        for (NodeId id = tree_[jump].parent; id != loop; id = tree_[id].parent)
            if (tree_[id].kind == NodeKind::if_else && has_count(tree_.child(id, 0)))
                return true;
        return false;
    }

    bool has_count(NodeId id) const {
        if (tree_[id].kind == NodeKind::name) {
            const auto name = facts_.names.find(text_.word_of(id));
            return name != facts_.names.end() && name->second.only_whole() && !name->second.uniform &&
                   !name->second.constant;
        }
        return std::ranges::any_of(tree_.children(id), [&](NodeId child) { return has_count(child); });
    }

    void visit(NodeId id) {
        const NodeKind kind = tree_[id].kind;
        if (is_loop(kind))
            return loop(id);
        const bool breaks = kind == NodeKind::jump && text_.word_of(id) == "break";
        if (!breaks && kind != NodeKind::return_statement)
            return;
        const NodeId left = left_by(id);
        if (left == k_no_node)
            return;
        const size_t index = index_of(left);
        edits_.wrap(
            id,
            fmt::format("{{{0}open[{1}]=false;{2}", prefix_, index,
                        tests_a_count(id, left) ? fmt::format("{}counts({},false);", prefix_, index) : ""),
            "}");
    }

    void loop(NodeId id) {
        const size_t index = index_of(id);
        if (const NodeId test = counter_test(text_, id); test != k_no_node)
            edits_.wrap(test, fmt::format("{}counts({},", prefix_, index), ")");
        if (const NodeId condition = loop_condition(text_, id);
            condition != k_no_node && is_expression(tree_[condition].kind))
            edits_.wrap(condition, fmt::format("({}open[{}]=(", prefix_, index), "))");
        const NodeId body = tree_[id].kind == NodeKind::loop_do    ? tree_.child(id, 0)
                            : tree_[id].kind == NodeKind::loop_for ? tree_.child(id, 3)
                                                                   : tree_.child(id, 1);
        edits_.wrap(body, fmt::format("{{{0}open[{1}]=true;++{0}turns;", prefix_, index), "}");
        edits_.wrap(id, fmt::format("{{{}open[{}]=false;", prefix_, index),
                    fmt::format("if({0}open[{1}]&&{0}turns>={3}){0}out[{2}]=1u;}}", prefix_, index,
                                LoopEnds::cut(index), k_fewest_of_a_limit));
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    std::string prefix_;
    SourceRewriter edits_;
    LoopEnds result_{};
};

} // namespace

double most_iterations(const ParsedText& text, const TreeFacts& facts) {
    return Iterations(text, facts).of_function("main");
}

LoopEnds record_loop_ends(const ParsedText& text, const TreeFacts& facts) {
    return EndRecorder(text, facts).run();
}

} // namespace tidemark::glsl
