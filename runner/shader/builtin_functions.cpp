#include "shader/builtin_functions.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <iterator>
#include <unordered_map>

namespace tidemark::glsl {
namespace {

using enum Trait;
using Args = const Arguments&;

// clang-format off
constexpr Domain k_not_negative{{{"x<0.0", [](Args a) { return a.x < 0; }, "of a negative number"}}, "x"};
constexpr Domain k_positive{{{"x<=0.0", [](Args a) { return a.x <= 0; }, "of a number that is not above 0"}}, "x"};
constexpr Domain k_power{{
    {"x<0.0", [](Args a) { return a.x < 0; }, "of a negative number"},
    {"(x==0.0&&y<=0.0)", [](Args a) { return a.x == 0 && a.y <= 0; }, "of 0 with an exponent that is not above 0"}}, "x"};
constexpr Domain k_up_to_one{{{"abs(x)>1.0", [](Args a) { return std::abs(a.x) > 1; }, "outside of [-1, 1]"}}, "1.0-abs(x)"};
constexpr Domain k_below_one{{{"abs(x)>=1.0", [](Args a) { return std::abs(a.x) >= 1; }, "outside of (-1, 1)"}}, "1.0-abs(x)"};
constexpr Domain k_from_one{{{"x<1.0", [](Args a) { return a.x < 1; }, "of a number below 1"}}, "x-1.0"};
constexpr Domain k_direction{{{"x==0.0&&y==0.0", [](Args a) { return a.x == 0 && a.y == 0; }, "of 0 and 0"}}, "abs(x)+abs(y)"};
constexpr Domain k_divisor{{{"y==0.0", [](Args a) { return a.y == 0; }, "by 0"}}, "abs(y)", "y"};
constexpr Domain k_edges{{{"x==y", [](Args a) { return a.x == a.y; }, "with equal edges"}}, "abs(x-y)"};
constexpr Domain k_limits{{{"y>z", [](Args a) { return a.y > a.z; }, "with its low limit above its high one"}}, "z-y", "y"};
/// On the CPU x is the sum of squares, or any component: the square of a number this small underflows in
/// floats.
constexpr Domain k_length{{{"dot(x,x)==0.0", [](Args a) { return std::abs(a.x) < double(FLT_MIN); },
                            "of a vector whose squares add up to 0"}}, "dot(x,x)"};

// Notation of signatures, separated by semicolons: the result, then the parameters. F, I, U, B stand for the
// scalar and the vectors of float, int, uint, bool; V, W, X, Y for the vectors only; f, i, u, b for the
// scalar only; M for all float matrices, S for the square ones. All capitals of a signature have the same
// size. Any other text is a type name. > marks an `out` parameter, = a constant expression, ? an optional
// parameter. Where GLSL ES 3.00 has the function, only its signatures are listed.
constexpr BuiltinFunction k_functions[] = {
    // name, signatures, traits, value on the CPU, domain, replacement in GLSL ES 3.00
    // 8.1 Angle and trigonometry
    {"radians",          "F F",      pure,             [](Args a) { return a.x * 0.017453292519943295; }},
    {"degrees",          "F F",      pure,             [](Args a) { return a.x * 57.29577951308232; }},
    {"sin",              "F F",      costly,           [](Args a) { return std::sin(a.x); }},
    {"cos",              "F F",      costly,           [](Args a) { return std::cos(a.x); }},
    {"tan",              "F F",      costly,           [](Args a) { return std::tan(a.x); }},
    {"asin",             "F F",      costly,           [](Args a) { return std::asin(a.x); }, &k_up_to_one},
    {"acos",             "F F",      costly,           [](Args a) { return std::acos(a.x); }, &k_up_to_one},
    {"atan",             "F F; F F F", costly,         {}, &k_direction},
    {"sinh",             "F F",      costly,           [](Args a) { return std::sinh(a.x); }},
    {"cosh",             "F F",      costly,           [](Args a) { return std::cosh(a.x); }},
    {"tanh",             "F F",      costly,           [](Args a) { return std::tanh(a.x); }},
    {"asinh",            "F F",      costly},
    {"acosh",            "F F",      costly,           {}, &k_from_one},
    {"atanh",            "F F",      costly,           {}, &k_below_one},
    // 8.2 Exponentials
    {"pow",              "F F F",    costly | inexact, [](Args a) { return std::pow(a.x, a.y); }, &k_power},
    {"exp",              "F F",      costly | inexact, [](Args a) { return std::exp(a.x); }},
    {"log",              "F F",      costly | inexact, [](Args a) { return std::log(a.x); }, &k_positive},
    {"exp2",             "F F",      costly | inexact, [](Args a) { return std::exp2(a.x); }},
    {"log2",             "F F",      costly | inexact, [](Args a) { return std::log2(a.x); }, &k_positive},
    {"sqrt",             "F F",      costly | inexact, [](Args a) { return std::sqrt(a.x); }, &k_not_negative},
    {"inversesqrt",      "F F",      costly | inexact, [](Args a) { return 1 / std::sqrt(a.x); }, &k_positive},
    // 8.3 Common
    {"abs",              "F F; I I", pure,             [](Args a) { return std::abs(a.x); }},
    {"sign",             "F F; I I", pure},
    {"floor",            "F F",      pure,             [](Args a) { return std::floor(a.x); }},
    {"trunc",            "F F",      pure},
    {"round",            "F F",      pure},
    {"roundEven",        "F F",      pure},
    {"ceil",             "F F",      pure},
    {"fract",            "F F",      pure,             [](Args a) { return a.x - std::floor(a.x); }},
    {"mod",              "F F F; F F f", pure, [](Args a) { return a.x - a.y * std::floor(a.x / a.y); }, &k_divisor},
    {"modf",             "F F >F"},
    {"min",              "F F F; F F f; I I I; I I i; U U U; U U u", pure, [](Args a) { return std::min(a.x, a.y); }},
    {"max",              "F F F; F F f; I I I; I I i; U U U; U U u", pure, [](Args a) { return std::max(a.x, a.y); }},
    {"clamp",            "F F F F; F F f f; I I I I; I I i i; U U U U; U U u u", pure, {}, &k_limits},
    {"mix",              "F F F F; F F F f; F F F B", pure, [](Args a) { return a.x * (1 - a.z) + a.y * a.z; }},
    {"step",             "F F F; F f F", pure},
    {"smoothstep",       "F F F F; F f f F", pure,     {}, &k_edges},
    {"isnan",            "B F",      pure},
    {"isinf",            "B F",      pure},
    {"floatBitsToInt",   "I F",      pure | in_floats},
    {"floatBitsToUint",  "U F",      pure | in_floats},
    {"intBitsToFloat",   "F I",      pure},
    {"uintBitsToFloat",  "F U",      pure},
    {"fma",              "F F F F",  pure,             {}, {}, "a * b + c"},
    {"frexp",            "F F >I",   none,             {}, {}, "exp2 and log2"},
    {"ldexp",            "F F I",    pure,             {}, {}, "x * exp2(float(e))"},
    // 8.4 Packing
    {"packUnorm2x16",    "u vec2",   pure | in_floats},
    {"packSnorm2x16",    "u vec2",   pure | in_floats},
    {"packUnorm4x8",     "u vec4",   pure | in_floats, {}, {}, "shifts and masks"},
    {"packSnorm4x8",     "u vec4",   pure | in_floats, {}, {}, "shifts and masks"},
    {"unpackUnorm2x16",  "vec2 u",   pure},
    {"unpackSnorm2x16",  "vec2 u",   pure},
    {"unpackUnorm4x8",   "vec4 u",   pure,             {}, {}, "shifts and masks"},
    {"unpackSnorm4x8",   "vec4 u",   pure,             {}, {}, "shifts and masks"},
    {"packHalf2x16",     "u vec2",   pure | in_floats},
    {"unpackHalf2x16",   "vec2 u",   pure},
    {"packDouble2x32",   "double uvec2", pure,         {}, {}, "floats"},
    {"unpackDouble2x32", "uvec2 double", pure,         {}, {}, "floats"},
    // 8.5 Geometry
    {"length",           "f F",      costly | sums_squares},
    {"distance",         "f F F",    costly | sums_squares},
    {"dot",              "f F F",    pure | sums_squares},
    {"cross",            "vec3 vec3 vec3", pure | sums_squares},
    {"normalize",        "F F",      costly | sums_squares, {}, &k_length},
    {"faceforward",      "F F F F",  pure},
    {"reflect",          "F F F",    pure | sums_squares},
    {"refract",          "F F F f",  costly},
    // 8.6 Matrices
    {"matrixCompMult",   "M M M",    pure},
    {"outerProduct",     "mat2 vec2 vec2; mat3 vec3 vec3; mat4 vec4 vec4; mat2x3 vec3 vec2; mat3x2 vec2 vec3; "
                         "mat2x4 vec4 vec2; mat4x2 vec2 vec4; mat3x4 vec4 vec3; mat4x3 vec3 vec4", pure},
    {"transpose",        "S S; mat3x2 mat2x3; mat4x2 mat2x4; mat2x3 mat3x2; mat4x3 mat3x4; mat2x4 mat4x2; "
                         "mat3x4 mat4x3", pure},
    {"determinant",      "f S",      costly},
    {"inverse",          "S S",      costly},
    // 8.7 Comparisons of vectors
    {"lessThan",         "Y V V; Y W W; Y X X", pure},
    {"lessThanEqual",    "Y V V; Y W W; Y X X", pure},
    {"greaterThan",      "Y V V; Y W W; Y X X", pure},
    {"greaterThanEqual", "Y V V; Y W W; Y X X", pure},
    {"equal",            "Y V V; Y W W; Y X X; Y Y Y", pure},
    {"notEqual",         "Y V V; Y W W; Y X X; Y Y Y", pure},
    {"any",              "b Y",      pure},
    {"all",              "b Y",      pure},
    {"not",              "Y Y",      pure},
    // 8.8 Whole numbers
    {"uaddCarry",        "U U U >U", none,             {}, {}, "a + b, and whether that is below a"},
    {"usubBorrow",       "U U U >U", none,             {}, {}, "a - b, and whether a is below b"},
    {"umulExtended",     "void U U >U >U", none,       {}, {}, "products of halves"},
    {"imulExtended",     "void I I >I >I", none,       {}, {}, "products of halves"},
    {"bitfieldExtract",  "I I i i; U U i i", pure,     {}, {}, "shifts and masks"},
    {"bitfieldInsert",   "I I I i i; U U U i i", pure, {}, {}, "shifts and masks"},
    {"bitfieldReverse",  "I I; U U", pure,             {}, {}, "shifts and masks"},
    {"bitCount",         "I I; I U", pure,             {}, {}, "a loop over the bits"},
    {"findLSB",          "I I; I U", pure,             {}, {}, "a loop over the bits"},
    {"findMSB",          "I I; I U", pure,             {}, {}, "a loop over the bits"},
    // 8.9 Textures
    {"textureSize",          "ivec2 sampler2D i; ivec2 samplerCube i; ivec3 sampler3D i"},
    {"textureQueryLod",      "vec2 sampler2D vec2; vec2 samplerCube vec3; vec2 sampler3D vec3", in_floats, {}, {},
                             "derivatives of the coordinate"},
    {"textureQueryLevels",   "i sampler2D; i samplerCube; i sampler3D", none, {}, {}, "a constant"},
    {"texture",              "vec4 sampler2D vec2 ?f; vec4 samplerCube vec3 ?f; vec4 sampler3D vec3 ?f",
                             implicit_lod | in_floats},
    {"textureProj",          "vec4 sampler2D vec3 ?f; vec4 sampler2D vec4 ?f; vec4 sampler3D vec4 ?f",
                             implicit_lod | in_floats},
    {"textureLod",           "vec4 sampler2D vec2 f; vec4 samplerCube vec3 f; vec4 sampler3D vec3 f", in_floats},
    {"textureOffset",        "vec4 sampler2D vec2 =ivec2 ?f; vec4 sampler3D vec3 =ivec3 ?f", implicit_lod},
    {"texelFetch",           "vec4 sampler2D ivec2 i; vec4 sampler3D ivec3 i", in_floats},
    {"texelFetchOffset",     "vec4 sampler2D ivec2 i =ivec2; vec4 sampler3D ivec3 i =ivec3"},
    {"textureProjOffset",    "vec4 sampler2D vec3 =ivec2 ?f; vec4 sampler2D vec4 =ivec2 ?f; "
                             "vec4 sampler3D vec4 =ivec3 ?f", implicit_lod},
    {"textureLodOffset",     "vec4 sampler2D vec2 f =ivec2; vec4 sampler3D vec3 f =ivec3"},
    {"textureProjLod",       "vec4 sampler2D vec3 f; vec4 sampler2D vec4 f; vec4 sampler3D vec4 f", in_floats},
    {"textureProjLodOffset", "vec4 sampler2D vec3 f =ivec2; vec4 sampler2D vec4 f =ivec2; vec4 sampler3D vec4 f =ivec3"},
    {"textureGrad",          "vec4 sampler2D vec2 vec2 vec2; vec4 samplerCube vec3 vec3 vec3; "
                             "vec4 sampler3D vec3 vec3 vec3", in_floats},
    {"textureGradOffset",    "vec4 sampler2D vec2 vec2 vec2 =ivec2; vec4 sampler3D vec3 vec3 vec3 =ivec3"},
    {"textureProjGrad",      "vec4 sampler2D vec3 vec2 vec2; vec4 sampler2D vec4 vec2 vec2; "
                             "vec4 sampler3D vec4 vec3 vec3", in_floats},
    {"textureProjGradOffset", "vec4 sampler2D vec3 vec2 vec2 =ivec2; vec4 sampler2D vec4 vec2 vec2 =ivec2; "
                             "vec4 sampler3D vec4 vec3 vec3 =ivec3"},
    {"textureGather",        "vec4 sampler2D vec2 ?=i; vec4 samplerCube vec3 ?=i", none, {}, {}, "four texelFetch"},
    {"textureGatherOffset",  "vec4 sampler2D vec2 ivec2 ?=i", none, {}, {}, "four texelFetch"},
    {"textureGatherOffsets", "vec4 sampler2D vec2 =ivec2[4] ?=i", none, {}, {}, "four texelFetch"},
    // 8.13 Fragments
    {"dFdx",             "F F",      derivative},
    {"dFdy",             "F F",      derivative},
    {"dFdxFine",         "F F",      derivative,       {}, {}, "dFdx"},
    {"dFdyFine",         "F F",      derivative,       {}, {}, "dFdy"},
    {"dFdxCoarse",       "F F",      derivative,       {}, {}, "dFdx"},
    {"dFdyCoarse",       "F F",      derivative,       {}, {}, "dFdy"},
    {"fwidth",           "F F",      derivative},
    {"fwidthFine",       "F F",      derivative,       {}, {}, "fwidth"},
    {"fwidthCoarse",     "F F",      derivative,       {}, {}, "fwidth"},
    {"interpolateAtCentroid", "F F", none,             {}, {}, "the input itself"},
    {"interpolateAtSample",   "F F i", none,           {}, {}, "the input itself"},
    {"interpolateAtOffset",   "F F vec2", none,        {}, {}, "the input itself"},
};
// clang-format on

/// Splits `list` at `separator`, and drops blanks before the parts and empty parts.
std::vector<std::string_view> parts(std::string_view list, char separator) {
    std::vector<std::string_view> result;
    for (size_t begin = 0; begin < list.size();) {
        const size_t end = std::min(list.find(separator, begin), list.size());
        std::string_view part = list.substr(begin, end - begin);
        part.remove_prefix(std::min(part.find_first_not_of(' '), part.size()));
        if (!part.empty())
            result.push_back(part);
        begin = end + 1;
    }
    return result;
}

/// Returns how many sizes the capitals of a signature stand for.
int sizes(std::string_view signature) {
    if (signature.find('M') != std::string_view::npos)
        return int(std::size(k_matrices));
    if (signature.find('S') != std::string_view::npos)
        return k_square_matrices;
    if (signature.find_first_of("VWXY") != std::string_view::npos)
        return 3;
    return signature.find_first_of("FIUB") != std::string_view::npos ? 4 : 1;
}

/// Returns the type that a letter or name of a signature stands for at one size.
std::string_view type_of(std::string_view word, int size) {
    if (word.size() > 1)
        return word;
    if (word == "M" || word == "S")
        return k_matrices[size];
    if (const size_t kind = std::string_view("fiub").find(word); kind != std::string_view::npos)
        return k_vectors[4 * kind];
    if (const size_t kind = std::string_view("VWXY").find(word); kind != std::string_view::npos)
        return k_vectors[4 * kind + size_t(size) + 1];
    return k_vectors[4 * std::string_view("FIUB").find(word) + size_t(size)];
}

std::vector<BuiltinOverload> expand(const BuiltinFunction& function) {
    std::vector<BuiltinOverload> overloads;
    for (const std::string_view signature : parts(function.signatures, ';'))
        for (int size = 0; size < sizes(signature); ++size) {
            const auto words = parts(signature, ' ');
            BuiltinOverload overload{type_of(words[0], size), {}};
            for (std::string_view word : std::span(words).subspan(1)) {
                BuiltinParameter parameter;
                for (; std::string_view("?>=").find(word[0]) != std::string_view::npos;
                     word.remove_prefix(1)) {
                    if (word[0] == '?')
                        overloads.push_back(overload);
                    parameter.written = parameter.written || word[0] == '>';
                    parameter.constant = parameter.constant || word[0] == '=';
                }
                parameter.type = type_of(word, size);
                overload.parameters.push_back(parameter);
            }
            overloads.push_back(std::move(overload));
        }
    return overloads;
}

/// Returns whether GLSL converts type `from` to `to` implicitly.
bool converts(const ValueType& from, const ValueType& to) {
    return from.columns == to.columns && from.rows == to.rows &&
           (to.base == 'f' ? from.base != 'b' : to.base == 'u' && from.base == 'i');
}

/// Counts the arguments that must be converted for an overload; nothing if it does not accept them.
std::optional<int> conversions(const BuiltinOverload& overload, std::span<const ValueType> arguments) {
    if (overload.parameters.size() != arguments.size())
        return std::nullopt;
    int count = 0;
    for (size_t i = 0; i < arguments.size(); ++i) {
        const auto wanted = value_type(overload.parameters[i].type);
        if (!wanted || (*wanted != arguments[i] && !converts(arguments[i], *wanted)))
            return std::nullopt;
        count += *wanted != arguments[i];
    }
    return count;
}

} // namespace

const UndefinedWhere* Domain::broken(const Arguments& arguments) const {
    const auto* found = std::ranges::find_if(
        undefined, [&](const UndefinedWhere& where) { return where.holds && where.holds(arguments); });
    return found == std::end(undefined) ? nullptr : found;
}

std::span<const BuiltinFunction> builtin_functions() {
    return k_functions;
}

const BuiltinFunction* find_builtin(std::string_view name) {
    static const auto k_by_name = [] {
        std::unordered_map<std::string_view, const BuiltinFunction*> all;
        for (const BuiltinFunction& function : k_functions)
            all.emplace(function.name, &function);
        return all;
    }();
    const auto found = k_by_name.find(name);
    return found == k_by_name.end() ? nullptr : found->second;
}

std::span<const BuiltinOverload> overloads_of(const BuiltinFunction& function) {
    static const auto k_overloads = [] {
        std::unordered_map<std::string_view, std::vector<BuiltinOverload>> all;
        for (const BuiltinFunction& each : k_functions)
            all.emplace(each.name, expand(each));
        return all;
    }();
    return k_overloads.at(function.name);
}

size_t most_parameters(const BuiltinFunction& function) {
    return std::ranges::max(overloads_of(function), {},
                            [](const BuiltinOverload& overload) { return overload.parameters.size(); })
        .parameters.size();
}

bool takes_constants(const BuiltinFunction& function) {
    return function.signatures.find('=') != std::string_view::npos;
}

std::optional<ValueType> type_of_call(const BuiltinFunction& function, std::span<const ValueType> arguments) {
    const BuiltinOverload* best = nullptr;
    int fewest = 0;
    for (const BuiltinOverload& overload : overloads_of(function))
        if (const auto count = conversions(overload, arguments); count && (!best || *count < fewest)) {
            best = &overload;
            fewest = *count;
        }
    return best ? value_type(best->result) : std::nullopt;
}

unsigned builtin_written_arguments(std::string_view name) {
    const BuiltinFunction* const function = find_builtin(name);
    if (!function || function->signatures.find('>') == std::string_view::npos)
        return 0;
    unsigned written = 0, bit = 1;
    for (const BuiltinParameter& parameter : overloads_of(*function).front().parameters) {
        written |= parameter.written ? bit : 0;
        bit <<= 1;
    }
    return written;
}

} // namespace tidemark::glsl
