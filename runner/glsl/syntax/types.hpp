// GLSL's scalar, vector and matrix types, by name and as values, and the result types of operations. Doubles,
// structures and arrays have no `ValueType`.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tidemark::glsl {

/// For each base type: the scalar, then its vectors.
inline constexpr std::string_view k_vectors[] = {"float", "vec2",  "vec3",  "vec4",  "int",   "ivec2",
                                                 "ivec3", "ivec4", "uint",  "uvec2", "uvec3", "uvec4",
                                                 "bool",  "bvec2", "bvec3", "bvec4"};
inline constexpr auto k_float_vectors = std::span(k_vectors).first<4>();
inline constexpr auto k_whole_vectors = std::span(k_vectors).subspan<4>();
/// The square ones come first.
inline constexpr std::string_view k_matrices[] = {"mat2",   "mat3",   "mat4",   "mat2x3", "mat2x4",
                                                  "mat3x2", "mat3x4", "mat4x2", "mat4x3"};
inline constexpr int k_square_matrices = 3;

struct ValueType {
    char base = 'f'; ///< f, i, u or b
    int columns = 1; ///< more than 1 for matrices only
    int rows = 1;

    bool scalar() const { return columns == 1 && rows == 1; }
    bool vector() const { return columns == 1 && rows > 1; }
    bool matrix() const { return columns > 1; }
    bool operator==(const ValueType&) const = default;
};

/// Returns the type of that name.
std::optional<ValueType> value_type(std::string_view name);
std::string to_string(const ValueType& type);
/// Returns the type of a number literal; nothing for doubles.
std::optional<ValueType> type_of_literal(std::string_view digits);
/// Returns the type of `left op right` for + - * /; nothing for any other operator.
std::optional<ValueType> type_of_operation(std::string_view op, const ValueType& left,
                                           const ValueType& right);
/// Returns the type of `vector.member`.
std::optional<ValueType> type_of_member(const ValueType& vector, std::string_view member);

enum class TypeClass : unsigned char { none, floating, whole, sampler, nothing };

/// Classifies a type name: `vec3` is floating, `bvec2` whole, `void` nothing; doubles and unknown names are
/// none.
TypeClass class_of_type(std::string_view word);

/// Returns whether the name is `float`, `vec2`, … or `mat4x4`.
inline bool is_float_type(std::string_view word) {
    return class_of_type(word) == TypeClass::floating;
}
/// Returns the double type (`dvec2`) for a float type; any other name unchanged.
std::string double_type_of(std::string_view type);
/// Maps `dvec2` to `vec2`; empty for any other name.
std::string_view float_type_of(std::string_view double_type);

} // namespace tidemark::glsl
