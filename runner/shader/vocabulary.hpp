// Name tables for the front end: names that desktop drivers reserve, keywords, names of old APIs, brackets.
// The host's uniforms: scene::k_host_uniforms.
#pragma once

#include "scene/host_uniforms.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tidemark::glsl {

using scene::k_channel_names;
using scene::k_channel_structs;

/// A name of an old API and its current equivalent.
struct OldName {
    std::string_view name;
    std::string_view today;
};

inline constexpr OldName k_old_names[] = {
    {"iGlobalTime", "iTime"},
    {"iGlobalFrame", "iFrame"},
    {"texture2D", "texture"},
    {"textureCube", "texture"},
    {"texture3D", "texture"},
    {"texture2DProj", "textureProj"},
    {"texture2DLod", "textureLod"},
    {"texture2DLodEXT", "textureLod"},
    {"texture2DProjLod", "textureProjLod"},
    {"texture2DProjLodEXT", "textureProjLod"},
    {"textureCubeLod", "textureLod"},
    {"textureCubeLodEXT", "textureLod"},
    {"texture3DLod", "textureLod"},
    {"texture2DGrad", "textureGrad"},
    {"texture2DGradEXT", "textureGrad"},
    {"texture2DGradARB", "textureGrad"},
    {"textureCubeGrad", "textureGrad"},
    {"textureCubeGradEXT", "textureGrad"},
    {"textureCubeGradARB", "textureGrad"},
    {"textureGradEXT", "textureGrad"},
    {"textureLodEXT", "textureLod"},
};

/// Names that ShaderToy texts use legally (or that are at least published there), but that are keywords in
/// some version that Tidemark offers to drivers.
inline constexpr std::string_view k_reserved_words[] = {"packed",
                                                        "row_major",
                                                        "buffer",
                                                        "shared",
                                                        "sample",
                                                        "precise",
                                                        "patch",
                                                        "subroutine",
                                                        "resource",
                                                        "active",
                                                        "filter",
                                                        "input",
                                                        "output",
                                                        "common",
                                                        "partition",
                                                        "dmat2",
                                                        "dmat3",
                                                        "dmat4",
                                                        "superp",
                                                        "coherent",
                                                        "restrict",
                                                        "readonly",
                                                        "writeonly",
                                                        "samplerCubeArray",
                                                        "isamplerCubeArray",
                                                        "usamplerCubeArray",
                                                        "external",
                                                        "interface",
                                                        "cast",
                                                        "noperspective"};

/// Keywords that are neither types nor functions; sorted.
inline constexpr std::string_view k_keywords[] = {
    "break",     "case",   "centroid", "const",   "continue", "default", "discard",   "do",
    "else",      "false",  "flat",     "for",     "highp",    "if",      "in",        "inout",
    "invariant", "layout", "lowp",     "mediump", "out",      "precise", "precision", "return",
    "smooth",    "struct", "switch",   "true",    "uniform",  "void",    "while"};
static_assert(std::ranges::is_sorted(k_keywords));

inline bool is_keyword(std::string_view word) {
    return std::ranges::binary_search(k_keywords, word);
}

inline bool is_one_of(std::string_view word, std::span<const std::string_view> words) {
    return std::ranges::find(words, word) != words.end();
}

/// Returns 1 for an opening parenthesis, bracket or brace, -1 for a closing one, else 0.
inline int nesting(std::string_view word) {
    const size_t sign = word.size() == 1 ? std::string_view("([{)]}").find(word[0]) : word.npos;
    return sign == word.npos ? 0 : sign < 3 ? 1 : -1;
}

inline bool is_precision(std::string_view word) {
    return word == "highp" || word == "mediump" || word == "lowp";
}

// GLSL's scalar, vector and matrix types, by name and as values, and the result types of operations. Doubles,
// structures and arrays have no `ValueType`.

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

// Reads GLSL numbers.

/// Reads `12`, `0x1F`, `017`, without sign and suffix. Returns nothing for other texts and if the value
/// exceeds `long`.
std::optional<long> whole_number(std::string_view digits);

/// Reads `12u`, `1.5f`, `1e2`. Returns nothing for other texts, hexadecimal numbers included.
std::optional<double> number(std::string_view word);

// Non-ASCII characters in code, which GLSL does not have; suggests the ASCII character that was probably
// meant.

struct StrangeCharacter {
    std::string name;         ///< name for messages: `'−' (U+2212)`, `a byte that is no UTF-8 (0xff)`
    bool blank = false;       ///< looks like a blank, or is invisible
    std::string_view instead; ///< suggested replacement; empty if there is none
};

/// Describes the first character of `text`. Returns nothing for ASCII, and for a byte in the middle of a
/// character.
std::optional<StrangeCharacter> strange_character(std::string_view text);

/// Returns advice for a message about a character that is not blank.
std::string advice_on(const StrangeCharacter& character);

} // namespace tidemark::glsl
