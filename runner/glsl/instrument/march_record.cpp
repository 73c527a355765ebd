#include "glsl/instrument/march_record.hpp"

#include "base/try.hpp"
#include "glsl/instrument/source_rewriter.hpp"
#include "glsl/syntax/word_edits.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::glsl {
namespace {

/// GLSL before the text; `$` is a prefix that no name of the text has. `on`: this loop is the first one
/// entered. The flags are those of HitFlag.
constexpr std::string_view k_prelude = R"(#undef TIDEMARK_HIT
#define mainHit tidemark_own_hit
int $entries = 0;
int $turns = 0;
int $begun = 0;
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
        if (stops_before && $limit > 0.0 && $sign < -1e-5 * max(1.0, abs(p)))
            $flags |= $turns == 1 ? 4 : 2;
    }
    return holds;
}
bool $bound(bool on, bool holds, bool stopping) {
    if (on) $out = holds == stopping;
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
    if (@ > 2.5) hit = vec4($fall, $fall_place, 0.0, 0.0);
    else if (@ > 1.5) hit = vec4($place, float($turns), $last, $limit);
    else if (@ > 0.5) hit = color;
}
)";

/// Text to insert around the tokens [begin, end).
struct Wrap {
    size_t begin, end;
    std::string before, after;
};

class Recorder {
public:
    Recorder(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts), prefix_(fresh_prefix(text)), edits_(text) {}

    Result<text::MappedText> run(std::span<const MarchLines> marches) {
        for (const Word& word : text_.words())
            if (word.is("discard"))
                return fail(ErrorCode::load, "the text discards pixels");
        for (const MarchLines& lines : marches)
            record(TRY(find_march(text_, facts_, lines)), lines);
        TRY(check_words(marches));
        insert();
        text::MappedText whole;
        whole.append_generated(spell(k_prelude, prefix_));
        whole.append(edits_.apply());
        whole.append_generated(spell(k_main_hit, prefix_, k_record_knob));
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
        for (const Wrap& wrap : wraps_)
            if (!edits_.begins_alone(wrap.begin) || !edits_.begins_alone(wrap.end))
                return fail(ErrorCode::load, fmt::format("{}:{}: the march stands in a macro",
                                                         marches[0].test.file, marches[0].test.line));
        return {};
    }

    /// Inserts at one place first the ends, inner before outer, and then the beginnings, outer before inner.
    void insert() {
        std::vector<size_t> order(wraps_.size());
        for (size_t i = 0; i < order.size(); ++i)
            order[i] = i;
        std::ranges::sort(order, [&](size_t a, size_t b) {
            const Wrap &x = wraps_[a], &y = wraps_[b];
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
    WordEdits edits_;
    std::vector<Wrap> wraps_; ///< those around the same tokens: outer first
};

} // namespace

Result<text::MappedText> record_marches(const ParsedText& text, const TreeFacts& facts,
                                        std::span<const MarchLines> marches) {
    return Recorder(text, facts).run(marches);
}

} // namespace tidemark::glsl
