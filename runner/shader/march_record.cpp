#include "shader/march_record.hpp"

#include "base/error.hpp"
#include "shader/lens_text.hpp"
#include "shader/parsed_text.hpp"
#include "shader/source_edits.hpp"

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
            return unknown("the limit of the march's number of steps is not found");
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
            return unknown("the test of the distance is not in its loop");
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

namespace {

/// GLSL before the text; `$` is a prefix that no name of the text has, `@` the answer. `on`: this loop is the
/// first one entered. The flags are those of HitFlag.
constexpr std::string_view k_prelude = R"(#undef TIDEMARK_HIT
#define mainHit tidemark_own_hit
int $entries = 0;
int $turns = 0;
int $begun = 0;
int $allowed = 0;
int $flags = 0;
float $last = 0.0;
float $sign = 0.0;
float $limit = 0.0;
float $place = 0.0;
float $begin = 0.0;
float $before = 0.0;
float $fall = 0.0;
float $fall_place = 0.0;
float $previous = 0.0;
bool $out = false;
vec4 $origin = vec4(0.0);
float $along(float p) { return p; }
float $along(vec2 p) { return length(p - $origin.xy); }
float $along(vec3 p) { return length(p - $origin.xyz); }
float $along(vec4 p) { return length(p - $origin); }
vec4 $wide(float p) { return vec4(p); }
vec4 $wide(vec2 p) { return vec4(p, 0.0, 0.0); }
vec4 $wide(vec3 p) { return vec4(p, 0.0); }
vec4 $wide(vec4 p) { return p; }
bool $enter(vec4 p) {
    ++$entries;
    if ($entries == 1) $origin = p;
    return $entries == 1;
}
void $turn(bool on, float p) {
    if (!on) return;
    ++$begun;
    $before = $begin;
    $begin = p;
}
float $distance(bool on, float x) {
    if (on) $last = x;
    return x;
}
float $signed(bool on, float x) {
    if (on) $sign = x;
    return x;
}
float $threshold(bool on, float x) {
    if (on) $limit = x;
    return x;
}
void $measure(float p) {
    float way = abs(p - $place);
    float fall = ($previous - $sign) / way;
    if ($turns > 0 && way > 1e-3 * max(1.0, abs(p)) && fall > $fall) {
        $fall = fall;
        $fall_place = p;
    }
    $previous = $sign;
    $place = p;
    ++$turns;
}
bool $tested(bool on, bool holds, float p, bool measured, bool stops_before) {
    if (on && measured) {
        $measure(p);
        if (stops_before && $limit > 0.0 && $sign < -max($limit, 1e-5 * max(1.0, abs(p))))
            $flags |= $turns == 1 ? 4 : 2;
    }
    return holds;
}
bool $bound(bool on, bool holds, bool stopping) {
    if (!on) return holds;
    $out = holds == stopping;
    if ($out && @ > 4.5) {
        if ($allowed == 0) $allowed = 4 * $begun;
        if ($begun < $allowed) {
            $out = false;
            return !stopping;
        }
    }
    return holds;
}
)";

/// GLSL after the text; `@` is the knob.
constexpr std::string_view k_main_hit = R"(
#undef mainHit
void mainHit(out vec4 hit, in vec2 fragCoord) {
    vec4 color = vec4(0.0);
    mainImage(color, fragCoord);
    bool met = $turns > 0 && $last <= $limit;
    float none = $last == $last ? -1.0 : $last;
    hit = vec4(met ? $place : none, float($turns), $last, float($flags + ($out && !met ? 1 : 0)));
    if (@ > 5.5) hit = color;
    else if (@ > 4.5) return;
    else if (@ > 3.5)
        hit = $lens(vec4(float($begun), 0.0, 0.0, $entries == 0 ? 0.0 : $out && !met ? 2.0 : 1.0), color);
    else if (@ > 2.5) hit = vec4($fall, $fall_place, 0.0, 0.0);
    else if (@ > 1.5) hit = vec4($place, float($turns), $last, $limit);
    else if (@ > 0.5) hit = color;
}
)";

/// Text to insert around the tokens [begin, end).
struct Around {
    size_t begin, end;
    std::string before, after;
};

class Recorder {
public:
    Recorder(const ParsedText& text, const TreeFacts& facts, std::optional<RecordAnswer> only)
        : text_(text), tree_(text.tree()), facts_(facts), prefix_(fresh_prefix(text)),
          answer_(only ? fmt::format("{}.0", int(*only)) : std::string(k_record_knob)), edits_(text) {}

    Result<text::MappedText> run(std::span<const MarchLines> marches) {
        for (const Word& word : text_.words())
            if (word.is("discard"))
                return fail(ErrorCode::load, "the text discards pixels");
        for (const MarchLines& lines : marches)
            record(TRY(find_march(text_, facts_, lines)), lines);
        TRY(check_words(marches));
        insert();
        text::MappedText whole;
        whole.append_generated(spell(k_lens_functions, prefix_));
        whole.append_generated(spell(k_prelude, prefix_, answer_));
        whole.append(edits_.apply());
        whole.append_generated(spell(k_main_hit, prefix_, answer_));
        return whole;
    }

private:
    /// Replaces NODE by `$name(on, NODE rest)`.
    void lead(NodeId node, std::string_view name, const std::string& rest = {}) {
        wraps_.push_back(
            {tree_[node].begin, tree_[node].end, fmt::format("{0}{1}({0}on,", prefix_, name), rest + ")"});
    }

    void record(const MarchNodes& march, const MarchLines& lines) {
        const Node& loop = tree_[march.loop];
        const std::string origin =
            march.place_before ? fmt::format("{}wide({})", prefix_, march.place) : "vec4(0.0)";
        wraps_.push_back(
            {loop.begin, loop.end, fmt::format("{{bool {0}on={0}enter({1});", prefix_, origin), "}"});
        const Node& body = tree_[body_of(tree_, march.loop)];
        const std::string turn = fmt::format("{0}turn({0}on,{0}along({1}));", prefix_, march.place);
        if (body.kind == NodeKind::block)
            wraps_.push_back({body.begin + 1, body.begin + 1, turn, ""});
        else
            wraps_.push_back({body.begin, body.end, "{" + turn, "}"});
        record_test(march, lines);
        for (const TurnLimit& limit : march.limits)
            lead(limit.test, "bound", limit.stopping ? ",true" : ",false");
    }

    void record_test(const MarchNodes& march, const MarchLines& lines) {
        std::string place = fmt::format("{}along({})", prefix_, march.place);
        std::string measured = "true";
        if (!lines.at_update && lines.in_next_turn && !march.in_head)
            place = prefix_ + "before";
        else if (!lines.at_update && (lines.in_next_turn || !march.in_head))
            place = prefix_ + "begin";
        if (lines.in_next_turn)
            measured = fmt::format("{}begun>{}", prefix_, march.in_head ? 0 : 1);
        lead(march.test, "tested",
             fmt::format(",{},{},{}", place, measured, lines.stops_before ? "true" : "false"));
        lead(march.distance, "distance");
        lead(with_sign(march.distance), "signed");
        lead(march.threshold, "threshold");
    }

    /// Returns the argument of `abs`, which still has its sign, or the distance itself.
    NodeId with_sign(NodeId distance) const {
        const NodeId inside = without_brackets(tree_, distance);
        const bool absolute = tree_[inside].kind == NodeKind::call && called_name(text_, inside) == "abs" &&
                              tree_.child_count(inside) == 2 && !facts_.function("abs");
        return absolute ? tree_.child(inside, 1) : distance;
    }

    /// Returns an error if an insertion would fall inside a macro's expansion.
    Result<void> check_words(std::span<const MarchLines> marches) const {
        for (const Around& wrap : wraps_)
            if (!edits_.begins_alone(wrap.begin) || !edits_.begins_alone(wrap.end))
                return fail(ErrorCode::load, fmt::format("{}:{}: the march is in a macro",
                                                         marches[0].test.file, marches[0].test.line));
        return {};
    }

    /// Inserts at one place first the ends, inner before outer, and then the beginnings, outer before inner.
    void insert() {
        std::vector<size_t> order(wraps_.size());
        for (size_t i = 0; i < order.size(); ++i)
            order[i] = i;
        std::ranges::sort(order, [&](size_t a, size_t b) {
            const Around &x = wraps_[a], &y = wraps_[b];
            return x.begin != y.begin ? x.begin > y.begin : x.end != y.end ? x.end < y.end : a > b;
        });
        for (const size_t i : order)
            if (!wraps_[i].after.empty())
                edits_.insert(wraps_[i].end, wraps_[i].after);
        std::ranges::reverse(order);
        for (const size_t i : order)
            edits_.insert(wraps_[i].begin, wraps_[i].before);
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    std::string prefix_;
    std::string answer_; ///< GLSL: a float
    WordEdits edits_;
    std::vector<Around> wraps_; ///< those around the same tokens: outer first
};

} // namespace

Result<text::MappedText> record_marches(const ParsedText& text, const TreeFacts& facts,
                                        std::span<const MarchLines> marches,
                                        std::optional<RecordAnswer> only) {
    return Recorder(text, facts, only).run(marches);
}

} // namespace tidemark::glsl
