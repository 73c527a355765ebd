#include "glsl/specialise/value_types.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::glsl {
namespace {

using Result = PureBuiltin::Result;

constexpr PureBuiltin k_builtins[] = {
    {"sin", Result::first, true},          {"cos", Result::first, true},
    {"tan", Result::first, true},          {"asin", Result::first, true},
    {"acos", Result::first, true},         {"atan", Result::widest, true},
    {"sinh", Result::first, true},         {"cosh", Result::first, true},
    {"tanh", Result::first, true},         {"exp", Result::first, true},
    {"exp2", Result::first, true},         {"log", Result::first, true},
    {"log2", Result::first, true},         {"pow", Result::widest, true},
    {"sqrt", Result::first, true},         {"inversesqrt", Result::first, true},
    {"normalize", Result::first, true},    {"length", Result::number, true},
    {"distance", Result::number, true},    {"abs", Result::first, false},
    {"sign", Result::first, false},        {"floor", Result::first, false},
    {"ceil", Result::first, false},        {"fract", Result::first, false},
    {"round", Result::first, false},       {"trunc", Result::first, false},
    {"radians", Result::first, false},     {"degrees", Result::first, false},
    {"mod", Result::widest, false},        {"min", Result::widest, false},
    {"max", Result::widest, false},        {"clamp", Result::widest, false},
    {"mix", Result::widest, false},        {"step", Result::widest, false},
    {"smoothstep", Result::widest, false}, {"dot", Result::number, false},
    {"cross", Result::vector3, false},     {"reflect", Result::first, false},
};

int digit(char c) {
    return c >= '2' && c <= '4' ? c - '0' : 0;
}

} // namespace

std::optional<ValueType> value_type(std::string_view name) {
    if (name == "float" || name == "int" || name == "uint" || name == "bool")
        return ValueType{name[0], 1, 1};
    const bool prefixed = name.starts_with("ivec") || name.starts_with("uvec") || name.starts_with("bvec");
    const char base = prefixed ? name[0] : 'f';
    if (prefixed)
        name.remove_prefix(1);
    if (name.starts_with("vec") && name.size() == 4 && digit(name[3]) > 0)
        return ValueType{base, 1, digit(name[3])};
    if (prefixed || !name.starts_with("mat"))
        return std::nullopt;
    name.remove_prefix(3);
    if (name.size() == 1 && digit(name[0]) > 0)
        return ValueType{'f', digit(name[0]), digit(name[0])};
    if (name.size() == 3 && name[1] == 'x' && digit(name[0]) > 0 && digit(name[2]) > 0)
        return ValueType{'f', digit(name[0]), digit(name[2])};
    return std::nullopt;
}

std::string to_string(const ValueType& type) {
    if (type.matrix())
        return fmt::format("mat{}x{}", type.columns, type.rows);
    const std::string_view scalar = type.base == 'f'   ? "float"
                                    : type.base == 'i' ? "int"
                                    : type.base == 'u' ? "uint"
                                                       : "bool";
    if (type.scalar())
        return std::string(scalar);
    return type.base == 'f' ? fmt::format("vec{}", type.rows) : fmt::format("{}vec{}", type.base, type.rows);
}

std::optional<ValueType> type_of_literal(std::string_view digits) {
    const bool hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
    const bool floating = !hexadecimal && digits.find_first_of(".eEfF") != std::string_view::npos;
    const bool is_unsigned = digits.ends_with('u') || digits.ends_with('U');
    if (digits.ends_with("lf") || digits.ends_with("LF"))
        return std::nullopt;
    return ValueType{floating ? 'f' : is_unsigned ? 'u' : 'i', 1, 1};
}

std::optional<ValueType> type_of_operation(std::string_view op, const ValueType& left,
                                           const ValueType& right) {
    if (op != "+" && op != "-" && op != "*" && op != "/")
        return std::nullopt;
    const bool mixed = left.base != right.base;
    if (left.base == 'b' || right.base == 'b' || (mixed && left.base != 'f' && right.base != 'f'))
        return std::nullopt;
    const char base = mixed ? 'f' : left.base;
    const auto as = [base](ValueType type) {
        type.base = base;
        return type;
    };
    if (left.scalar())
        return as(right);
    if (right.scalar())
        return as(left);
    if (op != "*" || (left.vector() && right.vector()))
        return left.columns == right.columns && left.rows == right.rows ? std::optional(as(left))
                                                                        : std::nullopt;
    if (left.vector()) // a row
        return left.rows == right.rows ? std::optional(ValueType{base, 1, right.columns}) : std::nullopt;
    if (left.columns != right.rows)
        return std::nullopt;
    return ValueType{base, right.columns, left.rows};
}

std::optional<ValueType> type_of_member(const ValueType& vector, std::string_view member) {
    if (!vector.vector() || member.empty() || member.size() > 4)
        return std::nullopt;
    for (const std::string_view names : {"xyzw", "rgba", "stpq"})
        if (std::all_of(member.begin(), member.end(), [&](char c) {
                return names.substr(0, size_t(vector.rows)).find(c) != std::string_view::npos;
            }))
            return ValueType{vector.base, 1, int(member.size())};
    return std::nullopt;
}

const PureBuiltin* find_pure_builtin(std::string_view name) {
    const auto found = std::find_if(std::begin(k_builtins), std::end(k_builtins),
                                    [&](const PureBuiltin& builtin) { return builtin.name == name; });
    return found == std::end(k_builtins) ? nullptr : found;
}

std::optional<ValueType> type_of_call(const PureBuiltin& builtin, std::span<const ValueType> arguments) {
    if (arguments.empty() ||
        std::any_of(arguments.begin(), arguments.end(), [](const ValueType& type) { return type.matrix(); }))
        return std::nullopt;
    ValueType type = arguments[0];
    for (const ValueType& argument : arguments) {
        type.rows = builtin.result == Result::widest ? std::max(type.rows, argument.rows) : type.rows;
        type.base = argument.base == 'f' ? 'f' : type.base;
    }
    constexpr std::string_view k_of_ints_too[] = {"abs", "sign", "min", "max", "clamp"};
    if (std::find(std::begin(k_of_ints_too), std::end(k_of_ints_too), builtin.name) ==
        std::end(k_of_ints_too))
        type.base = 'f';
    if (builtin.result == Result::number)
        return ValueType{};
    if (builtin.result == Result::vector3)
        return ValueType{'f', 1, 3};
    return type;
}

} // namespace tidemark::glsl
