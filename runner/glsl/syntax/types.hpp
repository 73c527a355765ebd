// The types that GLSL itself has for numbers, vectors and matrices, by name and as values, and what type an
// operation of them has. What is not covered (doubles, structures, arrays) has no `ValueType`.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tidemark::glsl {

/// Each kind's scalar, then its vectors.
inline constexpr std::string_view k_vectors[] = {"float", "vec2",  "vec3",  "vec4",  "int",   "ivec2",
                                                 "ivec3", "ivec4", "uint",  "uvec2", "uvec3", "uvec4",
                                                 "bool",  "bvec2", "bvec3", "bvec4"};
inline constexpr auto k_float_vectors = std::span(k_vectors).first<4>();
inline constexpr auto k_whole_vectors = std::span(k_vectors).subspan<4>();
/// Square ones first.
inline constexpr std::string_view k_matrices[] = {"mat2",   "mat3",   "mat4",   "mat2x3", "mat2x4",
                                                  "mat3x2", "mat3x4", "mat4x2", "mat4x3"};
inline constexpr int k_square_matrices = 3;

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

enum class TypeClass : unsigned char { none, floating, whole, sampler, nothing };

/// Of a word: `vec3` is floating, `bvec2` whole, `void` nothing; doubles and unknown names are none.
TypeClass class_of_type(std::string_view word);

/// `float`, `vec2` … `mat4x4`.
inline bool is_float_type(std::string_view word) {
    return class_of_type(word) == TypeClass::floating;
}
/// The same type of doubles (`dvec2`) of a float type; any other as it is.
std::string double_type_of(std::string_view type);
/// `dvec2` -> `vec2`; empty for any other word.
std::string_view float_type_of(std::string_view double_type);

} // namespace tidemark::glsl
