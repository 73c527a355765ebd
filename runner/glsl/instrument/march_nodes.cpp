#include "glsl/instrument/march_nodes.hpp"

#include "base/try.hpp"
#include "glsl/instrument/source_rewriter.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::glsl {
namespace {

bool same_line(const SourceLocation& a, const SourceLocation& b) {
    return a.line == b.line && a.file == b.file;
}

class MarchFinder {
public:
    MarchFinder(const ParsedText& text, const TreeFacts& facts, const MarchLines& lines)
        : text_(text), tree_(text.tree()), facts_(facts), lines_(lines) {}

    Result<MarchNodes> run() {
        TRY(find_test());
        TRY(find_place());
        find_limits();
        const NodeId head = head_of(tree_, found_.loop);
        const bool limited = head == k_no_node || tree_[head].kind == NodeKind::absent || found_.in_head ||
                             mentions(head, base_name(place_));
        if (found_.limits.empty() && !limited)
            return unknown("what ends the march after so many steps is not found");
        return std::move(found_);
    }

private:
    tl::unexpected<Error> unknown(std::string_view why) const {
        return fail(ErrorCode::load, fmt::format("{}:{}: {}", lines_.test.file, lines_.test.line, why));
    }

    // -- The comparison

    bool is_comparison(NodeId id) const {
        const std::string_view op = text_.word_of(id);
        return tree_[id].kind == NodeKind::binary && (op == "<" || op == ">" || op == "<=" || op == ">=");
    }

    NodeId loop_around(NodeId id) const {
        while (id != k_no_node && !is_loop(tree_[id].kind))
            id = tree_[id].parent;
        return id;
    }

    Result<void> find_test() {
        std::vector<NodeId> found;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            if (is_comparison(id) && same_line(text_.used(tree_[id].word), lines_.test) &&
                !(facts_.surely_whole[tree_.child(id, 0)] && facts_.surely_whole[tree_.child(id, 1)]) &&
                loop_around(id) != k_no_node)
                found.push_back(id);
        std::ranges::sort(found, {}, [&](NodeId id) { return tree_[id].word; });
        if (found.empty())
            return unknown("the test of the distance does not stand in its loop");
        if (found.size() != lines_.comparisons)
            return unknown("it is not certain which comparison tests the distance");
        found_.test = found[lines_.which];
        found_.loop = loop_around(found_.test);
        const std::string_view op = text_.word_of(found_.test);
        const bool left_is_less = op[0] == '<';
        const bool left = left_is_less == lines_.distance_is_less;
        found_.distance = tree_.child(found_.test, left ? 0 : 1);
        found_.threshold = tree_.child(found_.test, left ? 1 : 0);
        const NodeId head = head_of(tree_, found_.loop);
        found_.in_head = tree_[found_.loop].kind != NodeKind::loop_do && head != k_no_node &&
                         tree_.is_within(found_.test, head);
        return {};
    }

    // -- The place on the ray

    /// Returns whether the node is a name, perhaps with members, so that repeating it has no effect.
    bool is_plain_place(NodeId id) const {
        while (tree_[id].kind == NodeKind::member)
            id = tree_.child(id, 0);
        return tree_[id].kind == NodeKind::name;
    }

    std::string_view base_name(NodeId place) const { return text_.word_of(base_of(tree_, place)); }

    bool mentions(NodeId within, std::string_view name) const {
        for (size_t word = tree_[within].begin; word < tree_[within].end; ++word)
            if (text_.word(word) == name)
                return true;
        return false;
    }

    bool covers(NodeId id, const SourceLocation& line) const {
        const SourceLocation first = text_.used(tree_[id].begin), last = text_.used(tree_[id].end - 1);
        return first.file == line.file && first.line <= line.line && line.line <= last.line;
    }

    /// Returns whether a sum in `value` has `place` as a term.
    bool adds_to(NodeId value, const std::string& place) const {
        for (NodeId id = 1; id <= value; ++id) {
            const std::string_view op = text_.word_of(id);
            if (tree_[id].kind != NodeKind::binary || (op != "+" && op != "-") || !tree_.is_within(id, value))
                continue;
            if (words_of(text_, tree_.child(id, 0)) == place || words_of(text_, tree_.child(id, 1)) == place)
                return true;
        }
        return false;
    }

    bool goes_on(NodeId assignment) const {
        const std::string_view op = text_.word_of(assignment);
        const NodeId place = tree_.child(assignment, 0);
        if (op == "+=" || op == "-=")
            return true;
        return op == "=" && adds_to(tree_.child(assignment, 1), words_of(text_, place));
    }

    /// Returns the targets of assignments on the lines that advance the position, if `such` accepts them.
    template <class Such>
    std::vector<NodeId> targets(Such such) const {
        std::vector<NodeId> places;
        for (NodeId id = 1; id < found_.loop; ++id)
            if (tree_[id].kind == NodeKind::assign && tree_.is_within(id, found_.loop) &&
                std::ranges::any_of(lines_.updates, [&](const auto& line) { return covers(id, line); }) &&
                is_plain_place(tree_.child(id, 0)) && such(id) &&
                (lines_.fixed_steps || !is_counter(base_name(tree_.child(id, 0)))))
                places.push_back(tree_.child(id, 0));
        return places;
    }

    /// Finds `t += step` or, if there is none, `t *= factor`; if the distance is measured after the step,
    /// also `ahead = t + step`.
    Result<void> find_place() {
        std::vector<NodeId> places = targets([this](NodeId id) { return goes_on(id); });
        if (places.empty())
            places = targets([this](NodeId id) { return text_.word_of(id) == "*="; });
        if (places.empty() && lines_.at_update)
            places = targets([this](NodeId id) { return text_.word_of(id) == "="; });
        if (places.empty())
            return unknown("it is not certain what the march moves along its ray");
        place_ = places[0];
        found_.place = words_of(text_, place_);
        for (const NodeId other : places)
            if (words_of(text_, other) != found_.place)
                return unknown("the march moves more than one variable along its ray");
        return find_scope();
    }

    Result<void> find_scope() {
        found_.place_before = true;
        for (NodeId id = 1; id < found_.loop; ++id) {
            if (tree_[id].kind != NodeKind::declarator || !tree_.is_within(id, found_.loop) ||
                text_.word_of(id) != base_name(place_))
                continue;
            if (!opens(id))
                return unknown("the march keeps its place in more than one variable");
            found_.place_before = false;
        }
        return {};
    }

    /// Returns whether the node runs once, before the first iteration.
    bool opens(NodeId id) const {
        return tree_[found_.loop].kind == NodeKind::loop_for &&
               tree_.is_within(id, tree_.child(found_.loop, 0));
    }

    // -- Limits of the number of iterations

    /// Returns whether a value consists of literals only.
    bool is_literal(NodeId value) const {
        for (NodeId id = 1; id <= value; ++id)
            if (tree_.is_within(id, value) &&
                (tree_[id].kind == NodeKind::name || tree_[id].kind == NodeKind::call))
                return false;
        return true;
    }

    /// Returns whether the loop changes the variable, and only by literals.
    bool is_counter(std::string_view name) const {
        bool changes = false;
        for (NodeId id = 1; id < found_.loop; ++id) {
            if (!is_change(text_, id) || !tree_.is_within(id, found_.loop) || opens(id) ||
                base_name(tree_.child(id, 0)) != name)
                continue;
            const std::string_view op = text_.word_of(id);
            const bool counts =
                op == "++" || op == "--" || ((op == "+=" || op == "-=") && is_literal(tree_.child(id, 1)));
            if (!counts)
                return false;
            changes = true;
        }
        return changes;
    }

    /// Returns whether the loop assigns any variable named in `side`.
    bool changes(NodeId side) const {
        for (NodeId id = 1; id < found_.loop; ++id)
            if (is_change(text_, id) && tree_.is_within(id, found_.loop) && !opens(id) &&
                mentions(side, base_name(tree_.child(id, 0))))
                return true;
        return false;
    }

    /// Returns whether one side counts iterations up to the other side, which the loop does not change.
    bool limits_turns(NodeId comparison) const {
        const NodeId left = tree_.child(comparison, 0), right = tree_.child(comparison, 1);
        return (counts(left) && !changes(right)) || (counts(right) && !changes(left));
    }

    bool counts(NodeId side) const {
        while (tree_[side].kind == NodeKind::parenthesis || tree_[side].kind == NodeKind::prefix ||
               tree_[side].kind == NodeKind::postfix)
            side = tree_.child(side, 0);
        return tree_[side].kind == NodeKind::name && text_.word_of(side) != base_name(place_) &&
               is_counter(text_.word_of(side));
    }

    /// Adds the comparisons that on their own make the condition `stopping`.
    void add_limits(NodeId condition, bool stopping) {
        const Node& node = tree_[condition];
        const std::string_view joins = stopping ? "||" : "&&";
        if (node.kind == NodeKind::parenthesis)
            add_limits(tree_.child(condition, 0), stopping);
        else if (node.kind == NodeKind::binary && text_.word_of(condition) == joins)
            for (const NodeId part : tree_.children(condition))
                add_limits(part, stopping);
        else if (condition != found_.test && (is_comparison(condition) || text_.word_of(condition) == "!=") &&
                 node.kind == NodeKind::binary && limits_turns(condition))
            found_.limits.push_back({condition, stopping});
    }

    bool leaves(NodeId statement) const {
        const NodeKind kind = tree_[statement].kind;
        if (kind == NodeKind::block) {
            const auto inside = tree_.children(statement);
            return !inside.empty() && leaves(inside.back());
        }
        return kind == NodeKind::return_statement ||
               (kind == NodeKind::jump && text_.word_of(statement) == "break");
    }

    void find_limits() {
        if (const NodeId head = head_of(tree_, found_.loop); head != k_no_node)
            add_limits(head, false);
        for (NodeId id = 1; id < found_.loop; ++id)
            if (tree_[id].kind == NodeKind::if_else && loop_around(id) == found_.loop &&
                leaves(tree_.child(id, 1)))
                add_limits(tree_.child(id, 0), true);
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    const MarchLines& lines_;
    MarchNodes found_;
    NodeId place_ = k_no_node;
};

} // namespace

bool MarchLines::operator==(const MarchLines& other) const {
    return same_line(test, other.test) && which == other.which;
}

NodeId body_of(const SyntaxTree& tree, NodeId loop) {
    switch (tree[loop].kind) {
    case NodeKind::loop_for: return tree.child(loop, 3);
    case NodeKind::loop_while: return tree.child(loop, 1);
    default: return tree.child(loop, 0);
    }
}

NodeId head_of(const SyntaxTree& tree, NodeId loop) {
    return tree.child(loop, tree[loop].kind == NodeKind::loop_while ? 0 : 1);
}

Result<MarchNodes> find_march(const ParsedText& text, const TreeFacts& facts, const MarchLines& lines) {
    return MarchFinder(text, facts, lines).run();
}

} // namespace tidemark::glsl
