#include "base/encoding.hpp"
#include "shader/fixes.hpp"
#include "shader/tree_facts.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
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

} // namespace tidemark::glsl
