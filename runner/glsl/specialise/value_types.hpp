// The types that numbers and vectors of numbers have in expressions: enough to write down what an expression
// of uniforms is worth. What is not covered has no type.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tidemark::glsl {

struct ValueType {
    char base = 'f'; ///< f, i, u or b
    int columns = 1; ///< of a matrix
    int rows = 1;

    bool scalar() const { return columns == 1 && rows == 1; }
    bool vector() const { return columns == 1 && rows > 1; }
    bool matrix() const { return columns > 1; }
    bool operator==(const ValueType&) const = default;
};

/// Of a type's name.
std::optional<ValueType> value_type(std::string_view name);
std::string to_string(const ValueType& type);
/// Of a number as it is written; doubles have none.
std::optional<ValueType> type_of_literal(std::string_view digits);

/// Of `left op right`, no assignment.
std::optional<ValueType> type_of_operation(std::string_view op, const ValueType& left,
                                           const ValueType& right);
/// Of `vector.member`.
std::optional<ValueType> type_of_member(const ValueType& vector, std::string_view member);

/// A built-in function that only computes.
struct PureBuiltin {
    std::string_view name;
    enum class Result { first, widest, number, vector3 } result; ///< its type: that of which argument
    bool costly; ///< worth to be computed once instead of in every turn of a loop
};
const PureBuiltin* find_pure_builtin(std::string_view name);
std::optional<ValueType> type_of_call(const PureBuiltin& builtin, std::span<const ValueType> arguments);

} // namespace tidemark::glsl
