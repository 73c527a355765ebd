#include "glsl/syntax/builtins.hpp"

#include <algorithm>
#include <iterator>

namespace tidemark::glsl {
namespace {

constexpr std::string_view k_float_types[] = {"float",  "mat2",   "mat2x2", "mat2x3", "mat2x4", "mat3",
                                              "mat3x2", "mat3x3", "mat3x4", "mat4",   "mat4x2", "mat4x3",
                                              "mat4x4", "vec2",   "vec3",   "vec4"};

constexpr std::string_view k_whole_types[] = {"bool",  "bvec2", "bvec3", "bvec4", "int",   "ivec2",
                                              "ivec3", "ivec4", "uint",  "uvec2", "uvec3", "uvec4"};

constexpr std::string_view k_functions[] = {"abs",
                                            "acos",
                                            "acosh",
                                            "all",
                                            "any",
                                            "asin",
                                            "asinh",
                                            "atan",
                                            "atanh",
                                            "bitCount",
                                            "bitfieldExtract",
                                            "bitfieldInsert",
                                            "bitfieldReverse",
                                            "ceil",
                                            "clamp",
                                            "cos",
                                            "cosh",
                                            "cross",
                                            "dFdx",
                                            "dFdxCoarse",
                                            "dFdxFine",
                                            "dFdy",
                                            "dFdyCoarse",
                                            "dFdyFine",
                                            "degrees",
                                            "determinant",
                                            "distance",
                                            "dot",
                                            "equal",
                                            "exp",
                                            "exp2",
                                            "faceforward",
                                            "findLSB",
                                            "findMSB",
                                            "floatBitsToInt",
                                            "floatBitsToUint",
                                            "floor",
                                            "fma",
                                            "fract",
                                            "frexp",
                                            "fwidth",
                                            "fwidthCoarse",
                                            "fwidthFine",
                                            "greaterThan",
                                            "greaterThanEqual",
                                            "imulExtended",
                                            "intBitsToFloat",
                                            "interpolateAtCentroid",
                                            "interpolateAtOffset",
                                            "interpolateAtSample",
                                            "inverse",
                                            "inversesqrt",
                                            "isinf",
                                            "isnan",
                                            "ldexp",
                                            "length",
                                            "lessThan",
                                            "lessThanEqual",
                                            "log",
                                            "log2",
                                            "matrixCompMult",
                                            "max",
                                            "min",
                                            "mix",
                                            "mod",
                                            "modf",
                                            "normalize",
                                            "not",
                                            "notEqual",
                                            "outerProduct",
                                            "packDouble2x32",
                                            "packHalf2x16",
                                            "packSnorm2x16",
                                            "packSnorm4x8",
                                            "packUnorm2x16",
                                            "packUnorm4x8",
                                            "pow",
                                            "radians",
                                            "reflect",
                                            "refract",
                                            "round",
                                            "roundEven",
                                            "sign",
                                            "sin",
                                            "sinh",
                                            "smoothstep",
                                            "sqrt",
                                            "step",
                                            "tan",
                                            "tanh",
                                            "texelFetch",
                                            "texelFetchOffset",
                                            "texture",
                                            "textureGather",
                                            "textureGatherOffset",
                                            "textureGatherOffsets",
                                            "textureGrad",
                                            "textureGradOffset",
                                            "textureLod",
                                            "textureLodOffset",
                                            "textureOffset",
                                            "textureProj",
                                            "textureProjGrad",
                                            "textureProjGradOffset",
                                            "textureProjLod",
                                            "textureProjLodOffset",
                                            "textureProjOffset",
                                            "textureQueryLevels",
                                            "textureQueryLod",
                                            "textureSize",
                                            "transpose",
                                            "trunc",
                                            "uaddCarry",
                                            "uintBitsToFloat",
                                            "umulExtended",
                                            "unpackDouble2x32",
                                            "unpackHalf2x16",
                                            "unpackSnorm2x16",
                                            "unpackSnorm4x8",
                                            "unpackUnorm2x16",
                                            "unpackUnorm4x8",
                                            "usubBorrow"};

constexpr std::string_view k_keywords[] = {
    "break",     "case",   "centroid", "const",   "continue", "default", "discard",   "do",
    "else",      "false",  "flat",     "for",     "highp",    "if",      "in",        "inout",
    "invariant", "layout", "lowp",     "mediump", "out",      "precise", "precision", "return",
    "smooth",    "struct", "switch",   "true",    "uniform",  "void",    "while"};

static_assert(std::is_sorted(std::begin(k_float_types), std::end(k_float_types)));
static_assert(std::is_sorted(std::begin(k_whole_types), std::end(k_whole_types)));
static_assert(std::is_sorted(std::begin(k_functions), std::end(k_functions)));
static_assert(std::is_sorted(std::begin(k_keywords), std::end(k_keywords)));

} // namespace

bool is_float_type(std::string_view word) {
    return std::binary_search(std::begin(k_float_types), std::end(k_float_types), word);
}

std::string double_type_of(std::string_view float_type) {
    return float_type == "float" ? "double" : "d" + std::string(float_type);
}

std::string_view float_type_of(std::string_view double_type) {
    if (double_type == "double")
        return "float";
    return double_type.starts_with('d') && is_float_type(double_type.substr(1)) ? double_type.substr(1)
                                                                                : std::string_view{};
}

bool is_whole_type(std::string_view word) {
    return std::binary_search(std::begin(k_whole_types), std::end(k_whole_types), word);
}

bool is_builtin_function(std::string_view name) {
    return std::binary_search(std::begin(k_functions), std::end(k_functions), name);
}

unsigned builtin_written_arguments(std::string_view name) {
    if (name == "modf" || name == "frexp")
        return 0b10;
    if (name == "uaddCarry" || name == "usubBorrow")
        return 0b100;
    return name == "umulExtended" || name == "imulExtended" ? 0b1100 : 0;
}

bool is_keyword(std::string_view word) {
    return std::binary_search(std::begin(k_keywords), std::end(k_keywords), word);
}

} // namespace tidemark::glsl
