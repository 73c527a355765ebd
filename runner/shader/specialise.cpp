// Finds conditions whose outcome is known before the program runs: comparisons of literals, constants and
// knobs at their current values. Exact: a value that needs rounding counts as unknown.

#include "shader/specialise.hpp"

#include "base/encoding.hpp"
#include "scene/knob.hpp"
#include "shader/parsed_text.hpp"
#include "shader/tree_facts.hpp"
#include "shader/uniform_expressions.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tidemark::glsl {

class ConstantFolding {
public:
    /// `variables` are those of the whole text. Keeps references to its arguments.
    ConstantFolding(const ParsedText& text, const Variables& variables, std::span<const scene::Knob> knobs)
        : text_(text), tree_(text.tree()), variables_(variables), knobs_(knobs) {}

    /// Returns nothing if the outcome is not known.
    std::optional<bool> outcome(NodeId condition) const;

private:
    enum class Kind { truth, whole, floating };
    struct Value {
        Kind kind;
        double number; ///< holds every int and every float
    };
    using Known = std::optional<Value>;

    Known evaluate(NodeId expression) const;
    Known literal(std::string_view digits) const;
    Known name(std::string_view name) const;
    Known constant(const Variable& variable) const;
    Known member(NodeId member) const;
    Known prefix(NodeId prefix) const;
    Known binary(NodeId binary) const;
    static Known compare(std::string_view op, const Value& a, const Value& b);
    static Known compute(std::string_view op, const Value& a, const Value& b);
    static Known knob_value(const scene::Knob& knob, int component);
    const scene::Knob* find_knob(std::string_view name) const;

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const Variables& variables_;
    std::span<const scene::Knob> knobs_;
    mutable std::unordered_map<std::string_view, Known> constants_; ///< computed so far
    mutable int constants_open_ = 0;                                ///< number of constants under evaluation
};

// Moves costly expressions of uniforms out of loops into global variables with a value, which are computed
// once per pixel. llvmpipe does not do this itself.

namespace {

/// Longest chain of constants defined by constants.
constexpr int k_most_constants = 30;
/// Largest magnitude up to which every whole number is a float.
constexpr double k_largest_whole_float = 16777216.0;

/// Returns whether the number is zero or a normal float: a device may flush smaller ones to zero.
bool is_plain(double number) {
    return number == 0 || std::isnormal(float(number));
}

} // namespace

std::optional<bool> ConstantFolding::outcome(NodeId condition) const {
    const Known value = evaluate(condition);
    return value && value->kind == Kind::truth ? std::optional(value->number != 0) : std::nullopt;
}

auto ConstantFolding::evaluate(NodeId expression) const -> Known {
    switch (tree_[expression].kind) {
    case NodeKind::literal: return literal(text_.word_of(expression));
    case NodeKind::name: return name(text_.word_of(expression));
    case NodeKind::member: return member(expression);
    case NodeKind::parenthesis: return evaluate(tree_.child(expression, 0));
    case NodeKind::prefix: return prefix(expression);
    case NodeKind::binary: return binary(expression);
    default: return std::nullopt;
    }
}

auto ConstantFolding::literal(std::string_view digits) const -> Known {
    if (digits.find_first_of(".eEfF") != std::string_view::npos && !digits.starts_with("0x") &&
        !digits.starts_with("0X")) {
        if (digits.ends_with('f') || digits.ends_with('F'))
            digits.remove_suffix(1);
        const auto number = number_from<float>(digits);
        return number && is_plain(*number) ? Known({Kind::floating, *number}) : std::nullopt;
    }
    const auto number = whole_number(digits);
    return number && *number == int(*number) ? Known({Kind::whole, double(*number)}) : std::nullopt;
}

const scene::Knob* ConstantFolding::find_knob(std::string_view name) const {
    for (const scene::Knob& knob : knobs_)
        if (knob.name == name)
            return &knob;
    return nullptr;
}

auto ConstantFolding::knob_value(const scene::Knob& knob, int component) -> Known {
    const double number = knob.value[size_t(component)];
    if (scene::info(knob.type).whole)
        return Value{Kind::whole, number};
    return is_plain(number) ? Known({Kind::floating, float(number)}) : std::nullopt;
}

/// Returns nothing for a name that is declared more than once: it may mean another variable.
auto ConstantFolding::name(std::string_view name) const -> Known {
    if (name == "true" || name == "false")
        return Value{Kind::truth, double(name == "true")};
    const auto found = variables_.find(name);
    if (found == variables_.end() || found->second.times != 1)
        return std::nullopt;
    const Variable& variable = found->second;
    if (const scene::Knob* knob = find_knob(name))
        return scene::info(knob->type).components == 1 && has_qualifier(text_, variable.type, "uniform")
                   ? knob_value(*knob, 0)
                   : std::nullopt;
    const auto [known, fresh] = constants_.try_emplace(name);
    if (fresh) {
        const Known value = constant(variable);
        constants_[name] = value; // looked up again, since others were inserted
        return value;
    }
    return known->second; // nothing for a constant defined by itself
}

auto ConstantFolding::constant(const Variable& variable) const -> Known {
    const bool global = tree_[tree_[variable.type].parent].parent == 0 &&
                        tree_[variable.declared].kind == NodeKind::declarator;
    const NodeId value = tree_.child(variable.declared, 0);
    if (!global || !has_qualifier(text_, variable.type, "const") || value == k_no_node ||
        dimensions(text_, variable.type, variable.declared) > 0 || constants_open_ >= k_most_constants)
        return std::nullopt;
    ++constants_open_;
    Known known = evaluate(value);
    --constants_open_;
    const std::string_view type = type_name(text_, variable.type);
    if (known && known->kind == Kind::whole && type == "float" &&
        std::abs(known->number) <= k_largest_whole_float)
        known->kind = Kind::floating;
    const bool fits = known && ((type == "float" && known->kind == Kind::floating) ||
                                (type == "int" && known->kind == Kind::whole) ||
                                (type == "bool" && known->kind == Kind::truth));
    return fits ? known : std::nullopt;
}

/// Returns one component of a knob.
auto ConstantFolding::member(NodeId member) const -> Known {
    const NodeId of = tree_.child(member, 0);
    const std::string_view component = text_.word_of(member);
    if (tree_[of].kind != NodeKind::name || component.size() != 1)
        return std::nullopt;
    const scene::Knob* knob = find_knob(text_.word_of(of));
    const auto found = variables_.find(text_.word_of(of));
    if (!knob || found == variables_.end() || found->second.times != 1)
        return std::nullopt;
    for (const std::string_view names : {"xyzw", "rgba", "stpq"})
        if (const size_t i = names.find(component[0]);
            i != std::string_view::npos && int(i) < scene::info(knob->type).components)
            return knob_value(*knob, int(i));
    return std::nullopt;
}

auto ConstantFolding::prefix(NodeId prefix) const -> Known {
    Known value = evaluate(tree_.child(prefix, 0));
    const std::string_view op = text_.word_of(prefix);
    if (!value)
        return value;
    if (op == "!" && value->kind == Kind::truth)
        return Value{Kind::truth, double(value->number == 0)};
    if (op == "-" && value->kind == Kind::floating)
        return Value{Kind::floating, -value->number};
    if (op == "-" && value->kind == Kind::whole && value->number > -2147483648.0)
        return Value{Kind::whole, 0.0 - value->number};
    return op == "+" && value->kind != Kind::truth ? value : std::nullopt;
}

auto ConstantFolding::binary(NodeId binary) const -> Known {
    const std::string_view op = text_.word_of(binary);
    const Known a = evaluate(tree_.child(binary, 0));
    if (!a)
        return std::nullopt; // the left side may have side effects, which must stay
    const bool logical = op == "&&" || op == "||";
    if (logical && a->kind == Kind::truth && (a->number != 0) == (op == "||"))
        return a;
    const Known b = evaluate(tree_.child(binary, 1));
    if (!b)
        return std::nullopt;
    if (logical || op == "^^") {
        if (a->kind != Kind::truth || b->kind != Kind::truth)
            return std::nullopt;
        return logical ? b : Known({Kind::truth, double(a->number != b->number)});
    }
    return op.find_first_of("<>=") != std::string_view::npos || op == "!=" ? compare(op, *a, *b)
                                                                           : compute(op, *a, *b);
}

/// A whole number compared with a float is converted to float.
auto ConstantFolding::compare(std::string_view op, const Value& a, const Value& b) -> Known {
    if ((a.kind == Kind::truth) != (b.kind == Kind::truth))
        return std::nullopt;
    for (const Value& value : {a, b})
        if (a.kind != b.kind && std::abs(value.number) > k_largest_whole_float && value.kind == Kind::whole)
            return std::nullopt;
    const auto truth = [](bool holds) { return Known({Kind::truth, double(holds)}); };
    if (op == "==" || op == "!=")
        return truth((a.number == b.number) == (op == "=="));
    if (a.kind == Kind::truth)
        return std::nullopt;
    if (op == "<" || op == "<=")
        return truth(op == "<" ? a.number < b.number : a.number <= b.number);
    if (op == ">" || op == ">=")
        return truth(op == ">" ? a.number > b.number : a.number >= b.number);
    return std::nullopt;
}

/// Computes with ints; nothing on overflow.
auto ConstantFolding::compute(std::string_view op, const Value& a, const Value& b) -> Known {
    if (a.kind != Kind::whole || b.kind != Kind::whole)
        return std::nullopt;
    const double result = op == "+"   ? a.number + b.number
                          : op == "-" ? a.number - b.number
                          : op == "*" ? a.number * b.number
                                      : INFINITY;
    return scene::fits_int(result) ? Known({Kind::whole, result}) : std::nullopt;
}

namespace {

constexpr std::string_view k_hoisted = "tidemark_hoisted";
constexpr int k_most_hoisted = 256;
/// Longest chain of local variables whose values are local variables.
constexpr int k_longest_alias_chain = 60;

class Hoister {
public:
    Hoister(const ParsedText& text, const std::vector<Global>& globals, const std::vector<bool>& reached,
            const std::vector<bool>& gone, WordEdits& edits)
        : text_(text), tree_(text.tree()), globals_(globals), reached_(reached), gone_(gone), edits_(edits),
          expressions_(text, globals) {
        for (const MacroLine& macro : text.preprocessed().macros)
            macros_.insert(macro.name);
    }

    int run() {
        find_hot_functions();
        for (size_t i = 0; i < globals_.size(); ++i)
            if (reached_[i] && tree_[globals_[i].node].kind == NodeKind::function &&
                edits_.begins_alone(tree_[globals_[i].node].begin))
                hoist_from(globals_[i]);
        return count_;
    }

private:
    bool is_gone(NodeId id) const { return !gone_.empty() && gone_[tree_[id].begin]; }

    /// Returns whether the node is in a loop of its own function.
    bool is_in_loop(NodeId id) const {
        for (NodeId child = id, around = tree_[id].parent; around != k_no_node;
             child = around, around = tree_[around].parent)
            if (is_loop(tree_[around].kind) &&
                !(tree_[around].kind == NodeKind::loop_for && tree_[around].first_child == child))
                return true;
        return false;
    }

    /// Finds functions that are called in a loop, and the functions that these call.
    void find_hot_functions() {
        std::unordered_map<std::string_view, std::vector<std::string_view>> calls;
        std::vector<std::string_view> open;
        for (size_t i = 0; i < globals_.size(); ++i) {
            const Global& global = globals_[i];
            if (!reached_[i] || tree_[global.node].kind != NodeKind::function)
                continue;
            for (NodeId id = global.first; id <= global.node; ++id) {
                if (tree_[id].kind != NodeKind::call || is_gone(id))
                    continue;
                calls[global.names[0]].push_back(called_name(text_, id));
                if (is_in_loop(id))
                    open.push_back(called_name(text_, id));
            }
        }
        while (!open.empty()) {
            const std::string_view name = open.back();
            open.pop_back();
            if (hot_.insert(name).second)
                open.insert(open.end(), calls[name].begin(), calls[name].end());
        }
    }

    void hoist_from(const Global& function) {
        expressions_.enter(function);
        const bool hot = hot_.contains(function.names[0]);
        declarations_.clear();
        aliases_.clear();
        for (NodeId id = function.node; id >= function.first;) { // parents first
            if (count_ < k_most_hoisted && is_worth_it(id, hot) && hoist_one(id))
                id = first_inside(id);
            --id;
        }
        if (!declarations_.empty())
            edits_.insert(tree_[function.node].begin, declarations_);
    }

    /// Returns the node with the lowest number below `id`.
    NodeId first_inside(NodeId id) const {
        while (tree_[id].first_child != k_no_node)
            id = tree_[id].first_child;
        return id;
    }

    bool is_worth_it(NodeId id, bool hot) const {
        if (!is_expression(tree_[id].kind) || is_gone(id))
            return false;
        const auto value = expressions_.value(id);
        return value && value->uniform && value->costly && (hot || is_in_loop(id)) &&
               edits_.stands_alone(tree_[id].begin, tree_[id].end);
    }

    /// Returns false if the expression cannot be written before its function.
    bool hoist_one(NodeId id) {
        const std::optional<std::string> name = declare(expressions_.value(id)->type, id);
        if (!name)
            return false;
        edits_.replace(tree_[id].begin, tree_[id].end, *name);
        ++count_;
        return true;
    }

    std::optional<std::string> declare(const ValueType& type, NodeId value) {
        const std::optional<std::string> spelled = spell(value);
        const std::string type_word = to_string(type);
        if (!spelled || macros_.contains(type_word))
            return std::nullopt;
        std::string name = fmt::format("{}{}", k_hoisted, variables_++);
        declarations_ += fmt::format("{} {} = {}; ", type_word, name, *spelled);
        return name;
    }

    /// Returns the text of an expression, with hoisted variables in place of local ones. Returns nothing if a
    /// token is the name of a macro, which would expand it.
    std::optional<std::string> spell(NodeId id) {
        std::string spelled;
        for (size_t i = tree_[id].begin; i < tree_[id].end; ++i) {
            const Word& word = text_.words()[i];
            const bool member = i > tree_[id].begin && text_.words()[i - 1].is(".");
            if (word.kind == text::TokenKind::identifier && macros_.contains(word.text))
                return std::nullopt;
            const auto* alias =
                word.kind == text::TokenKind::identifier && !member ? expressions_.alias(word.text) : nullptr;
            const std::optional<std::string> text =
                alias ? hoisted_alias(word.text, *alias) : std::string(word.text);
            if (!text)
                return std::nullopt;
            spelled += (spelled.empty() ? "" : " ") + *text;
        }
        return spelled;
    }

    std::optional<std::string> hoisted_alias(std::string_view name, const UniformExpressions::Alias& alias) {
        const auto known = aliases_.find(name);
        if (known != aliases_.end())
            return known->second;
        if (aliases_open_ >= k_longest_alias_chain)
            return std::nullopt;
        ++aliases_open_;
        auto declared = declare(alias.type, alias.value);
        --aliases_open_;
        aliases_.emplace(name, declared);
        return declared;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const std::vector<Global>& globals_;
    const std::vector<bool>& reached_;
    const std::vector<bool>& gone_;
    WordEdits& edits_;
    UniformExpressions expressions_;
    std::unordered_set<std::string_view> macros_;
    std::unordered_set<std::string_view> hot_;
    std::string declarations_; ///< to insert before the current function
    std::unordered_map<std::string_view, std::optional<std::string>> aliases_; ///< of the current function
    int count_ = 0;
    int variables_ = 0;
    int aliases_open_ = 0; ///< number of aliases whose values are being spelled
};

} // namespace

/// Adds the changes to `edits` and returns the number of moved expressions. Leaves `gone` tokens and globals
/// that are not `reached`.
int move_loop_invariants(const ParsedText& text, const std::vector<Global>& globals,
                         const std::vector<bool>& reached, const std::vector<bool>& gone, WordEdits& edits) {
    return Hoister(text, globals, reached, gone, edits).run();
}

namespace {

/// Returns a value as text that GLSL reads back to the same bits.
std::optional<std::string> spell(const scene::Knob& knob) {
    const scene::KnobTypeInfo& type = scene::info(knob.type);
    std::string numbers;
    for (int i = 0; i < type.components; ++i) {
        const double number = knob.value[size_t(i)];
        if (!std::isfinite(float(number)))
            return std::nullopt;
        numbers += i > 0 ? ", " : "";
        numbers += type.whole ? fmt::format("int({})", number) : fmt::format("{:#.9g}", float(number));
    }
    return fmt::format("{}({})", type.glsl_name, numbers);
}

class Specialiser {
public:
    Specialiser(const ParsedText& text, std::span<const scene::Knob> knobs, Specialise how)
        : text_(text), tree_(text.tree()), knobs_(knobs), how_(how), globals_(find_globals(text)),
          gone_(text.words().size(), false), edits_(text) {}

    Specialised run() {
        LeftOut done;
        if (how_ == Specialise::constants)
            done.constants = settle_knobs();
        if (how_ >= Specialise::invariant_uniforms)
            done.branches = eliminate_dead_branches();
        const std::vector<bool> reached = remove_unreached();
        if (how_ >= Specialise::invariant_uniforms && may_compute_first())
            done.loop_invariants = move_loop_invariants(text_, globals_, reached, gone_, edits_);
        done.lines = edits_.emptied_lines();
        done.kept_whole = edits_.empty() ? "there is nothing to leave out" : "";
        return {edits_.empty() ? text_.source() : edits_.apply(), std::move(done)};
    }

private:
    /// Desktop GLSL allows a global variable to start with a value that is not constant.
    bool may_compute_first() const { return !text_.is_es(); }

    bool remove(size_t begin, size_t end, std::string_view replacement = {}) {
        if (!edits_.stands_alone(begin, end))
            return false;
        edits_.replace(begin, end, replacement);
        std::fill(gone_.begin() + long(begin), gone_.begin() + long(end), true);
        return true;
    }

    int settle_knobs() {
        int count = 0;
        for (const Global& global : globals_) {
            if (tree_[global.node].kind != NodeKind::declaration || global.names.size() != 1 ||
                !has_qualifier(text_, tree_.child(global.node, 0), "uniform"))
                continue;
            const auto knob = std::find_if(knobs_.begin(), knobs_.end(), [&](const scene::Knob& each) {
                return each.name == global.names[0];
            });
            const auto value = knob == knobs_.end() ? std::nullopt : spell(*knob);
            const Node& node = tree_[global.node];
            if (!value || !edits_.stands_alone(node.begin, node.end))
                continue;
            edits_.replace(
                node.begin, node.end,
                fmt::format("const {} {} = {};", scene::info(knob->type).glsl_name, knob->name, *value));
            ++count;
        }
        return count;
    }

    int eliminate_dead_branches() {
        const Variables variables = find_variables(text_, 1, NodeId(tree_.nodes.size() - 1));
        const ConstantFolding conditions(text_, variables, knobs_);
        int count = 0;
        for (auto id = NodeId(tree_.nodes.size()); id-- > 1;) { // parents first
            const bool branch =
                tree_[id].kind == NodeKind::if_else || tree_[id].kind == NodeKind::conditional;
            if (!branch || gone_[tree_[id].begin])
                continue;
            if (const auto outcome = conditions.outcome(tree_.child(id, 0)))
                count += tree_[id].kind == NodeKind::if_else ? close_if(id, *outcome) : choose(id, *outcome);
        }
        return count;
    }

    /// Keeps only the statement that runs; a declaration has a scope of its own there, so that `if` stays.
    bool close_if(NodeId id, bool outcome) {
        const Node& whole = tree_[id];
        const NodeId taken = tree_.child(id, outcome ? 1 : 2);
        if (taken == k_no_node)
            return remove(whole.begin, whole.end, ";");
        const Node& kept = tree_[taken];
        const bool has_else = kept.end < whole.end;
        if (kept.kind == NodeKind::declaration || !edits_.stands_alone(whole.begin, kept.begin) ||
            (has_else && !edits_.stands_alone(kept.end, whole.end)))
            return false;
        remove(whole.begin, kept.begin);
        if (has_else)
            remove(kept.end, whole.end);
        return true;
    }

    /// `condition ? a : b` has the common type of both, so only a part that is surely a float can replace it.
    bool choose(NodeId id, bool outcome) {
        const Node& whole = tree_[id];
        const NodeId taken = tree_.child(id, outcome ? 1 : 2);
        const Node& kept = tree_[taken];
        const bool behind = kept.end < whole.end;
        if (!is_surely_floating(taken) || !edits_.stands_alone(whole.begin, kept.begin) ||
            (behind && !edits_.stands_alone(kept.end, whole.end)))
            return false;
        remove(whole.begin, kept.begin);
        if (behind)
            remove(kept.end, whole.end);
        return true;
    }

    /// Returns whether the node is a float literal or constructor, which needs no parentheses either.
    bool is_surely_floating(NodeId id) const {
        if (tree_[id].kind == NodeKind::literal)
            return text_.word_of(id).find('.') != std::string_view::npos;
        const auto built =
            tree_[id].kind == NodeKind::call ? value_type(called_name(text_, id)) : std::nullopt;
        return built && built->base == 'f';
    }

    std::vector<bool> remove_unreached() {
        std::vector<bool> kept(globals_.size());
        for (size_t i = 0; i < globals_.size(); ++i) {
            const Node& node = tree_[globals_[i].node];
            kept[i] = globals_[i].root || !edits_.stands_alone(node.begin, node.end);
        }
        std::vector<bool> reached = find_reached(text_, globals_, gone_, kept);
        for (size_t i = 0; i < globals_.size(); ++i)
            if (!reached[i])
                edits_.remove(tree_[globals_[i].node].begin, tree_[globals_[i].node].end);
        return reached;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    std::span<const scene::Knob> knobs_;
    Specialise how_;
    std::vector<Global> globals_;
    std::vector<bool> gone_; ///< tokens
    WordEdits edits_;
};

} // namespace

Specialised specialise(const text::MappedText& source, std::span<const scene::Knob> knobs, Specialise how) {
    if (how == Specialise::nothing)
        return {source};
    const auto text = ParsedText::read(source, {}, false);
    if (!text) {
        LeftOut nothing;
        nothing.kept_whole = to_string(text.error());
        return {source, std::move(nothing)};
    }
    return Specialiser(**text, knobs, how).run();
}

} // namespace tidemark::glsl
