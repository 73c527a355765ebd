#include "shader/cuts.hpp"

#include "base/encoding.hpp"
#include "shader/builtin_functions.hpp"
#include "shader/fixes.hpp"
#include "shader/loops.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

namespace tidemark::glsl {
namespace {

/// Cheaper operations are not tried: a driver needs no instruction for most of them.
constexpr double k_least_work = 4;
/// A part of a loop's iterations, and the chance that the picture stays with it.
struct Part {
    double share, chance;
};
constexpr std::array k_parts{Part{0.9, 0.5}, Part{0.75, 0.45}, Part{0.5, 0.35}, Part{0.25, 0.15}};
constexpr double k_fewest_turns = 2;

/// A march may end early where its step or its way passes a limit; `{}` stands for the way. `saved` estimates
/// the share of the iterations. A larger `strength` of the same family ends the march earlier.
struct Exit {
    const char* limit;
    double saved, strength;
    const char* family;
};
constexpr std::array k_exits_of_step{Exit{"< 0.01", 0.5, 3, "near"}, Exit{"< 0.003", 0.45, 2, "near"},
                                     Exit{"< 0.001", 0.4, 1, "near"}, Exit{"> 20.0", 0.2, 1, "leap"}};
constexpr std::array k_exits_of_way{Exit{"> 20.0", 0.3, 2, "far"}, Exit{"> 100.0", 0.15, 1, "far"}};
constexpr std::array k_exits_by_way{Exit{"< 0.004 * abs({})", 0.5, 3, "relative"},
                                    Exit{"< 0.002 * abs({})", 0.45, 2, "relative"},
                                    Exit{"< 0.001 * abs({})", 0.4, 1, "relative"}};
/// Factors of a number: of a threshold of a distance, of a limit of a way, of a march's step.
struct Factor {
    double factor, saved, strength;
};
constexpr std::array k_coarser{Factor{2, 0.15, 1}, Factor{3, 0.25, 2}, Factor{10, 0.4, 3}};
constexpr std::array k_nearer{Factor{0.75, 0.15, 1}, Factor{0.5, 0.3, 2}, Factor{0.25, 0.4, 3}};
constexpr std::array k_longer{Factor{1.1, 0.09, 1}, Factor{1.2, 0.16, 2}, Factor{1.5, 0.3, 3}};
constexpr double k_largest_threshold = 0.1, k_least_way = 4;
/// The least operations that are worth a test, and the chance that the picture stays with it.
constexpr double k_guarded = 100, k_chance_of_guard = 0.9;
/// Chances that a march keeps the picture if it ends earlier, or if its steps are longer.
constexpr double k_chance_of_exit = 0.5, k_chance_of_step = 0.4;
/// Chances of a term or value and of a statement that take no time; the whole text has none.
constexpr double k_chance_of_term = 0.1, k_chance_of_statement = 0.2, k_least_chance = 0.01;
/// Coarser levels show in nearly any picture.
constexpr int k_coarsest_level = 3;

/// Returns the source tokens from one token to another, unless one of them comes from a macro.
std::optional<WrittenTokens> between(const ParsedText& text, size_t first, size_t last) {
    const auto& words = text.words();
    for (size_t i = first; i <= last; ++i)
        if (words[i].from_macro())
            return std::nullopt;
    if (text.spelled(first).file.empty() || text.spelled(first).file != text.spelled(last).file)
        return std::nullopt;
    return WrittenTokens{words[first].used, words[last].used};
}

std::optional<WrittenTokens> between(const ParsedText& text, NodeId id) {
    return between(text, text.tree()[id].begin, text.tree()[id].end - 1);
}

/// Returns edits that choose between the number and the one that `replacing` gives, and that remove `const`
/// from the number's declaration.
std::vector<Wrap> chosen_number(const ParsedText& text, const Wrap& replacing, NodeId number) {
    Wrap choice = replacing;
    choice.replaces = false;
    choice.front = fmt::format("($ ? {} : ", replacing.front);
    choice.behind = ")";
    std::vector<Wrap> wraps{std::move(choice)};
    const NodeId declaration = text.tree().around(number, NodeKind::declaration);
    if (declaration == k_no_node)
        return wraps;
    for (size_t i = text.tree()[declaration].begin; i < text.tree()[number].begin; ++i)
        if (text.word(i) == "const")
            if (const auto word = between(text, i, i))
                wraps.push_back(in_place_of(text, *word, ""));
    return wraps;
}

/// Writes a number with four digits.
std::string number_text(double value) {
    return float_literal(fmt::format("{:.4g}", value));
}

bool has_jump(const ParsedText& text, NodeId id) {
    for (size_t i = text.tree()[id].begin; i < text.tree()[id].end; ++i)
        for (const std::string_view word : {"return", "discard"})
            if (text.word(i) == word)
                return true;
    return false;
}

/// Returns whether the call has a result that is needed: an `out` parameter, or an unknown function.
bool gives_out(const ParsedText& text, const TreeFacts& facts, NodeId call) {
    const FunctionFacts* const function = facts.function(called_name(text, call));
    if (!function)
        return true;
    for (const NodeId definition : function->definitions)
        for (const NodeId part : text.tree().children(definition))
            if (text.tree()[part].kind == NodeKind::parameter &&
                has_qualifier(text, text.tree().child(part, 0), "out"))
                return true;
    return false;
}

/// Returns whether the statement updates something that exists without it: `x += y`, `f(x)`.
bool may_be_left_out(const ParsedText& text, const TreeFacts& facts, NodeId expression) {
    const NodeKind kind = text.tree()[expression].kind;
    if (kind == NodeKind::assign)
        return text.word_of(expression) != "=";
    return kind == NodeKind::call && !gives_out(text, facts, expression);
}

std::string in_short(std::string words) {
    constexpr size_t k_longest = 60;
    if (words.size() > k_longest)
        words = words.substr(0, k_longest - 3) + "...";
    return words;
}

} // namespace

Cutter::Cutter(const ParsedText& text, const TreeFacts& facts)
    : text_(text), tree_(text.tree()), facts_(facts), work_(text, facts), kept_(tree_.nodes.size()) {
    find_kept();
    for (NodeId id = 1; id < tree_.nodes.size(); ++id)
        if (tree_[id].kind == NodeKind::function)
            whole_ = std::max(whole_, work_.of(id));
}

/// Returns the name of the family of cuts that change this node, which no other file's node has.
std::string Cutter::family_of(std::string_view what, NodeId id) const {
    return fmt::format("{} {} {}", what, place_of(id), tree_[id].begin);
}

/// Returns the chance that the picture stays without a part: the larger its share of the work, the more of
/// the picture it makes.
double Cutter::chance_without(double work, double chance) const {
    return std::max(k_least_chance, chance * (1 - work / std::max(whole_, 1.0)));
}

/// Repeats until such a loop calls no further function: prototypes let a definition follow its calls.
void Cutter::find_kept() {
    for (NodeId id = 1; id < tree_.nodes.size(); ++id)
        if (is_loop(tree_[id].kind) && !loop_bound(text_, id))
            endless_.push_back(id);
    std::set<std::string_view> called;
    size_t before = 0;
    do {
        before = called.size();
        mark_kept(called);
    } while (called.size() > before);
}

/// Goes from parents to children, which have smaller numbers.
void Cutter::mark_kept(std::set<std::string_view>& called) {
    for (NodeId id = NodeId(tree_.nodes.size()) - 1; id > 0; --id) {
        const NodeKind kind = tree_[id].kind;
        const NodeId parent = tree_[id].parent;
        // A loop's bound is not cut as an expression: add_turns changes it.
        const bool in_head =
            parent != k_no_node && is_loop(tree_[parent].kind) && loop_condition(text_, parent) == id;
        kept_[id] = kept_[id] || in_head || (parent != k_no_node && kept_[parent]) ||
                    (kind == NodeKind::function && called.contains(text_.word_of(id))) ||
                    std::ranges::binary_search(endless_, id);
        if (kept_[id] && kind == NodeKind::call)
            called.insert(called_name(text_, id));
    }
}

bool Cutter::is_kept(NodeId id) const {
    return kept_[id] || tree_.around(id, NodeKind::function) == k_no_node || must_stay_constant(text_, id);
}

bool Cutter::is_cheap(NodeId id) const {
    return work_.once(id) < k_least_work;
}

std::string Cutter::place_of(NodeId id) const {
    const SourceLocation written = text_.spelled(tree_[id].begin);
    const SourceLocation where = written.file.empty() ? text_.used(tree_[id].begin) : written;
    return fmt::format("{}:{}", where.file, where.line);
}

void Cutter::add(std::optional<WrittenTokens> tokens, std::string instead, std::string reason, double work,
                 std::vector<Cut>& cuts, std::optional<Wrap> switched) const {
    if (!tokens)
        return;
    cuts.push_back({{{in_place_of(text_, *tokens, std::move(instead))}, std::move(reason)}, work});
    cuts.back().chance = chance_without(work, k_chance_of_term);
    if (switched)
        cuts.back().switched = {*std::move(switched)};
}

/// Returns the edit that puts `neutral` in the place of an operand; nothing if the operation has another type
/// without the operand.
std::optional<Wrap> Cutter::switched_operand(NodeId id, NodeId rest, int neutral) const {
    const auto type = expression_type(text_, facts_, id),
               whole = expression_type(text_, facts_, tree_[id].parent),
               left = expression_type(text_, facts_, rest);
    const auto tokens = between(text_, id);
    if (!type || !tokens || (whole && left && *whole != *left))
        return std::nullopt;
    return wrapped(text_, *tokens, fmt::format("($ ? {}({}) : (", to_string(*type), neutral), "))");
}

/// Adds `a + b` without b and without a; likewise for `-` and `*`. Each operand of a chain is added once.
void Cutter::add_operands(NodeId id, std::vector<Cut>& cuts) const {
    const std::string_view op = text_.word_of(id);
    const bool product = op == "*";
    if (op != "+" && op != "-" && !product)
        return;
    const NodeId left = tree_.child(id, 0), right = tree_.child(id, 1);
    const char* const what = product ? "factor" : "term";
    if (!is_cheap(right))
        add(between(text_, tree_[id].word, tree_[right].end - 1), "",
            fmt::format("{}: leaves out the {} `{}`", place_of(right), what, in_short(text_.excerpt(right))),
            work_.of(right), cuts, switched_operand(right, left, product));
    const bool chain = tree_[left].kind == NodeKind::binary && text_.word_of(left) == op;
    if (!is_cheap(left) && !chain)
        add(between(text_, tree_[left].begin, tree_[id].word), op == "-" ? "-" : "",
            fmt::format("{}: leaves out the {} `{}`", place_of(left), what, in_short(text_.excerpt(left))),
            work_.of(left), cuts, switched_operand(left, right, product));
}

void Cutter::add_statement(NodeId id, std::vector<Cut>& cuts) const {
    const NodeKind kind = tree_[id].kind;
    if (is_cheap(id) || has_jump(text_, id))
        return;
    const bool whole = (kind == NodeKind::if_else && tree_.child_count(id) == 2) || is_loop(kind);
    if (!whole && (kind != NodeKind::expression || !may_be_left_out(text_, facts_, tree_.child(id, 0))))
        return;
    const Node& node = tree_[id];
    const bool in_block = tree_[node.parent].kind == NodeKind::block;
    const size_t before = cuts.size();
    const auto tokens = between(text_, id);
    add(tokens, in_block ? "" : ";",
        fmt::format("{}: leaves out `{}`", place_of(id), in_short(text_.excerpt(id))), work_.of(id), cuts,
        tokens ? std::optional(wrapped(text_, *tokens, "{ if (!$) ", " }")) : std::nullopt);
    if (cuts.size() > before)
        cuts.back().chance = chance_without(work_.of(id), k_chance_of_statement);
}

/// Adds tests by which a costly factor is computed only where the other one is not 0: a shadow where light
/// falls. They change the picture only where the factor is infinite or NaN.
void Cutter::add_guards(NodeId id, std::vector<Cut>& cuts) const {
    const bool assigns = tree_[id].kind == NodeKind::assign;
    const NodeId place = assigns ? tree_[id].parent : id;
    const auto whole = expression_type(text_, facts_, id);
    const auto tokens = between(text_, place);
    if (text_.word_of(id) != (assigns ? "*=" : "*") || !tokens ||
        (assigns ? tree_[place].kind != NodeKind::expression : !whole))
        return;
    for (const size_t side : {size_t(1), size_t(0)}) {
        const NodeId costly = tree_.child(id, side), other = tree_.child(id, 1 - side);
        const auto type = expression_type(text_, facts_, other);
        const auto written = between(text_, other);
        if ((assigns && side == 0) || work_.once(costly) < k_guarded || !type || !type->scalar() ||
            type->base != 'f' || !written)
            continue;
        const auto again = said_again(text_, facts_, other, *written);
        if (!again)
            continue;
        const std::string test = fmt::format("({}) != 0.0", *again);
        const std::string behind = assigns ? "" : fmt::format(" : {}(0))", to_string(*whole));
        const auto guard = [&](const std::string& condition) {
            return wrapped(text_, *tokens, (assigns ? "if (" : "(") + condition + (assigns ? ") " : " ? "),
                           behind);
        };
        cuts.push_back({.change = {{guard(test)},
                                   fmt::format("{}: computes `{}` only where `{}` is not 0", place_of(costly),
                                               in_short(text_.excerpt(costly)), *again)},
                        .work = work_.of(costly) / 2,
                        .chance = k_chance_of_guard,
                        .switched = {guard(fmt::format("(!$ || {})", test))}});
    }
}

void Cutter::add_turns(NodeId loop, std::vector<Cut>& cuts) const {
    const auto bound = loop_bound(text_, loop);
    if (!bound || kept_[loop])
        return;
    double before = bound->turns;
    for (const auto& [part, chance] : k_parts) {
        const double turns = std::max(k_fewest_turns, std::floor(part * bound->turns));
        if (!(turns < before))
            continue;
        before = turns;
        if (auto wrap = with_turns(text_, *bound, turns))
            cuts.push_back({.change = {{*wrap},
                                       fmt::format("{}: {:g} iterations of the loop instead of {:g}",
                                                   place_of(loop), turns, bound->turns)},
                            .work = work_.of(loop) * (1 - turns / bound->turns),
                            .chance = chance,
                            .family = family_of("turns", loop),
                            .strength = -turns,
                            .switched = chosen_number(text_, *wrap, bound->number)});
    }
}

/// Returns the loop that a `break` at this node would end; k_no_node if there is none.
NodeId Cutter::loop_around(NodeId id) const {
    for (id = tree_[id].parent; id != k_no_node; id = tree_[id].parent)
        if (is_loop(tree_[id].kind))
            return id;
        else if (tree_[id].kind == NodeKind::switch_on)
            break;
    return k_no_node;
}

/// Returns whether each iteration sets the variable to a value that costs something.
bool Cutter::is_computed_in(NodeId loop, std::string_view name) const {
    for (NodeId id = 1; id < loop; ++id) { // children have smaller numbers
        const bool declared = tree_[id].kind == NodeKind::declarator && text_.word_of(id) == name;
        const bool set = tree_[id].kind == NodeKind::assign && text_.word_of(id) == "=" &&
                         text_.word_of(tree_.child(id, 0)) == name;
        if ((declared || set) && tree_.child_count(id) > 0 && !is_cheap(id) && loop_around(id) == loop)
            return true;
    }
    return false;
}

/// Returns whether the text does not show that the expression is a vector.
bool Cutter::may_be_scalar(NodeId id) const {
    const auto type = expression_type(text_, facts_, id);
    return !type || type->scalar();
}

/// Returns the member `h.x` that a name `h` is used for, or the name itself.
NodeId Cutter::step_value(NodeId id) const {
    while (tree_[tree_[id].parent].kind == NodeKind::member)
        id = tree_[id].parent;
    return id;
}

/// Adds exits after `t += d`, where the loop computes the step `d`, and after `t += f(p)`: rays that have
/// arrived, or are far from everything, need no more iterations.
void Cutter::add_exits(NodeId step, std::vector<Cut>& cuts) const {
    const NodeId loop = loop_around(step), statement = tree_[step].parent;
    if (loop == k_no_node || text_.word_of(step) != "+=" || tree_[statement].kind != NodeKind::expression)
        return;
    const auto tokens = between(text_, statement);
    if (!tokens)
        return;
    const NodeId target = tree_.child(step, 0);
    const std::string way = tree_[target].kind == NodeKind::name && may_be_scalar(target)
                                ? std::string(text_.word_of(target))
                                : "";
    const auto add_exit = [&](const std::string& front, std::vector<Wrap> inner, std::string_view value,
                              const Exit& exit, const std::optional<WrittenTokens>& call) {
        std::string limit = exit.limit;
        if (const size_t place = limit.find("{}"); place != limit.npos)
            limit.replace(place, 2, way);
        inner.push_back(
            wrapped(text_, *tokens, "{ " + front, fmt::format(" if ({} {}) break; }}", value, limit)));
        std::vector<Wrap> switched{
            wrapped(text_, *tokens, call ? "{ float tidemark_step@; " : "{ ",
                    fmt::format(" if ($ && {} {}) break; }}", call ? "abs(tidemark_step@)" : value, limit))};
        if (call)
            switched.push_back(wrapped(text_, *call, "(tidemark_step@ = ", ")"));
        cuts.push_back({.change = {std::move(inner),
                                   fmt::format("{}: leaves the loop after `{}` if {} {}", place_of(step),
                                               in_short(text_.excerpt(step)), value, limit)},
                        .work = work_.of(loop) * exit.saved,
                        .chance = k_chance_of_exit,
                        .family = family_of(exit.family, step),
                        .strength = exit.strength,
                        .switched = std::move(switched)});
    };
    bool marches = false;
    for (NodeId id = 1; id < step && !marches; ++id) {
        if (!tree_.is_within(id, tree_.child(step, 1)) || !may_be_scalar(step_value(id)))
            continue;
        std::string front, value;
        std::vector<Wrap> inner;
        std::optional<WrittenTokens> call;
        if (tree_[id].kind == NodeKind::name && is_computed_in(loop, text_.word_of(id)))
            value = fmt::format("abs({})", text_.excerpt(step_value(id)));
        else if (calls_authors_function(text_, facts_, id) && !is_cheap(id) && type_of(id) &&
                 type_of(id)->scalar()) {
            const std::string name = fresh_name(text_, "march_step");
            front = fmt::format("float {} = {}; ", name, text_.excerpt(id));
            value = fmt::format("abs({})", name);
            call = between(text_, id);
            inner = {in_place_of(text_, *call, name)};
        } else
            continue;
        marches = true;
        for (const Exit& exit : k_exits_of_step)
            add_exit(front, inner, value, exit, call);
        if (!way.empty())
            for (const Exit& exit : k_exits_by_way)
                add_exit(front, inner, value, exit, call);
    }
    if (!marches)
        return;
    add_longer_steps(step, loop, cuts);
    if (!way.empty())
        for (const Exit& exit : k_exits_of_way)
            add_exit("", {}, way, exit, {});
}

/// Adds longer steps of a march: many step less far than their distance allows.
void Cutter::add_longer_steps(NodeId step, NodeId loop, std::vector<Cut>& cuts) const {
    const NodeId length = tree_.child(step, 1);
    const auto tokens = between(text_, length);
    if (!tokens || kept_[loop])
        return;
    for (const Factor& each : k_longer)
        cuts.push_back(
            {.change = {{wrapped(text_, *tokens, fmt::format("{} * (", number_text(each.factor)), ")")},
                        fmt::format("{}: {:g} times as long steps in `{}`", place_of(step), each.factor,
                                    in_short(text_.excerpt(step)))},
             .work = work_.of(loop) * each.saved,
             .chance = k_chance_of_step,
             .family = family_of("step", step),
             .strength = each.strength,
             .switched = {
                 wrapped(text_, *tokens, fmt::format("($ ? {} : 1.0) * (", number_text(each.factor)), ")")}});
}

/// Returns the loop that `if (test) break;` or `if (test) return …;` leaves; k_no_node for any other test.
NodeId Cutter::loop_left_by(NodeId test) const {
    NodeId id = test;
    while (is_expression(tree_[tree_[id].parent].kind))
        id = tree_[id].parent;
    const NodeId branch = tree_[id].parent;
    if (tree_[branch].kind != NodeKind::if_else || tree_.child(branch, 0) != id)
        return k_no_node;
    const Node& yes = tree_[tree_.child(branch, 1)];
    for (size_t i = yes.begin; i < yes.end; ++i)
        if (text_.word(i) == "break" || text_.word(i) == "return")
            return loop_around(branch);
    return k_no_node;
}

/// Adds other numbers for the limits at which a loop is left: `d < 0.0001` and `t > 100.0`. A name for the
/// number is changed at its definition, so that tests after the loop agree.
void Cutter::add_limits(NodeId test, const SingleValues& values, std::vector<Cut>& cuts) const {
    const std::string_view op = text_.word_of(test);
    const bool less = op == "<" || op == "<=";
    const NodeId loop = less || op == ">" || op == ">=" ? loop_left_by(test) : k_no_node;
    if (loop == k_no_node || work_.of(loop) == 0)
        return;
    for (const size_t side : {size_t(0), size_t(1)}) {
        const NodeId given = without_brackets(tree_, tree_.child(test, side)), value = values.of(given);
        const NodeId literal = without_brackets(tree_, value == k_no_node ? given : value);
        const std::string_view word = text_.word_of(literal);
        const auto size = tree_[literal].kind == NodeKind::literal ? number(word) : std::nullopt;
        const auto tokens = size ? written_for(text_, literal, literal) : std::nullopt;
        if (!tokens || word.find_first_of(".eE") == word.npos || word.starts_with("0x"))
            continue;
        const bool near = less == (side == 1);
        if (near ? !(*size > 0 && *size <= k_largest_threshold) : !(*size >= k_least_way))
            continue;
        for (const Factor& each : near ? k_coarser : k_nearer) {
            const std::string limit = number_text(*size * each.factor);
            const Wrap wrap = in_place_of(text_, *tokens, limit);
            cuts.push_back(
                {.change = {{wrap},
                            fmt::format("{}: leaves the loop by `{}` with {} instead of {}", place_of(test),
                                        in_short(text_.excerpt(test)), limit, word)},
                 .work = work_.of(loop) * each.saved,
                 .chance = k_chance_of_exit,
                 .family = family_of("limit", literal),
                 .strength = each.strength,
                 .switched = chosen_number(text_, wrap, literal)});
        }
    }
}

std::vector<Cut> Cutter::cuts() const {
    std::vector<Cut> cuts;
    const SingleValues values(text_, facts_);
    for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
        const NodeKind kind = tree_[id].kind;
        if (kind == NodeKind::binary)
            add_limits(id, values, cuts);
        if (is_loop(kind))
            add_turns(id, cuts);
        if (kind == NodeKind::assign)
            add_exits(id, cuts);
        if (is_kept(id) || work_.of(id) == 0)
            continue;
        if (kind == NodeKind::binary || kind == NodeKind::assign)
            add_guards(id, cuts);
        if (kind == NodeKind::binary)
            add_operands(id, cuts);
        else if (!is_expression(kind))
            add_statement(id, cuts);
    }
    std::ranges::stable_sort(cuts, std::greater<>(), &Cut::work);
    return cuts;
}

/// Returns the work of a look-up itself, without that of its coordinates.
double Cutter::work_of_call(NodeId id) const {
    double once = work_.once(id);
    for (const NodeId part : tree_.children(id))
        once -= work_.once(part);
    return work_.of(id) * once / work_.once(id);
}

/// With an implicit level the driver computes the level and mixes the two nearest, which is about half of the
/// work. A bias only adds to that level, so it saves nothing.
std::vector<Cut> Cutter::levels(const std::function<bool(std::string_view)>& has_mipmaps) const {
    std::vector<Cut> cuts;
    for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
        const auto call =
            tree_.child_count(id) == 3 ? look_up_by_neighbours(text_, facts_, id) : std::nullopt;
        if (!call || is_kept(id) || work_.of(id) == 0 || !has_mipmaps(text_.word_of(tree_.child(id, 1))))
            continue;
        for (int level = 0; level <= k_coarsest_level; ++level)
            cuts.push_back(
                {.change = {{in_place_of(text_, {call->first, call->first}, "textureLod"),
                             wrapped(text_, {call->last, call->last}, fmt::format(", {}.0", level), "")},
                            fmt::format("{}: reads only level {} in `{}`", place_of(id), level,
                                        in_short(text_.excerpt(id)))},
                 .work = work_of_call(id) / 2,
                 .switched = {wrapped(
                     text_, *call,
                     fmt::format("($ ? textureLod({}, {}, {}.0) : ", words_of(text_, tree_.child(id, 1)),
                                 words_of(text_, tree_.child(id, 2)), level),
                     ")")}});
    }
    return cuts;
}

/// Returns the float type of an expression if the text states it: a call of one of the author's functions, a
/// texture look-up, or the value in a variable's declaration.
std::optional<ValueType> Cutter::type_of(NodeId id) const {
    std::string_view name;
    if (tree_[tree_[id].parent].kind == NodeKind::declarator)
        name = tree_.child_count(tree_[id].parent) == 1
                   ? type_name(text_, tree_.child(tree_[tree_[id].parent].parent, 0))
                   : "";
    else if (tree_[id].kind == NodeKind::call) {
        const FunctionFacts* const function = facts_.function(called_name(text_, id));
        for (const NodeId definition : function ? function->definitions : std::vector<NodeId>{}) {
            const std::string_view type = type_name(text_, tree_.child(definition, 0));
            if (!name.empty() && type != name)
                return std::nullopt;
            name = type;
        }
        if (!function && called_name(text_, id).starts_with("texture"))
            name = called_name(text_, id).starts_with("textureSize") ? "" : "vec4";
    }
    const auto type = value_type(name);
    return type && type->base == 'f' && !type->matrix() ? type : std::nullopt;
}

std::vector<Replaceable> Cutter::replaceables() const {
    std::vector<Replaceable> found;
    for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
        if (!is_expression(tree_[id].kind) || is_cheap(id) || is_kept(id) || work_.of(id) == 0)
            continue;
        const auto type = type_of(id);
        if (type && written_for(text_, id, id) && text_.excerpt(id).find("++") == std::string::npos)
            found.push_back({id, *type, work_.of(id)});
    }
    std::ranges::stable_sort(found, std::greater<>(), &Replaceable::work);
    return found;
}

Cut Cutter::replaced(const Replaceable& expression, std::span<const double> numbers) const {
    std::string words;
    for (const double number : numbers)
        words += (words.empty() ? "" : ", ") + number_text(number);
    if (!expression.type.scalar())
        words = fmt::format("{}({})", to_string(expression.type), words);
    std::vector<Cut> cuts;
    const auto tokens = written_for(text_, expression.node, expression.node);
    add(tokens, words,
        fmt::format("{}: {} replaces `{}`", place_of(expression.node), words,
                    in_short(text_.excerpt(expression.node))),
        expression.work, cuts, wrapped(text_, *tokens, fmt::format("($ ? {} : (", words), "))"));
    return cuts.front();
}

} // namespace tidemark::glsl
