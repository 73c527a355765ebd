#include "glsl/specialise/constant_folding.hpp"

#include "glsl/syntax/number.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <charconv>
#include <cmath>

namespace tidemark::glsl {
namespace {

/// Longest chain of constants defined by constants.
constexpr int k_most_constants = 30;
/// Largest magnitude up to which every whole number is a float.
constexpr double k_largest_whole_float = 16777216.0;

std::optional<float> parse_float(std::string_view digits) {
    float number = 0;
    const char* const end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, number);
    return read.ec == std::errc{} && read.ptr == end ? std::optional(number) : std::nullopt;
}

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
        const auto number = parse_float(digits);
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

} // namespace tidemark::glsl
