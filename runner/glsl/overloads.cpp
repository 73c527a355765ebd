#include "glsl/overloads.hpp"

#include "glsl/rewrite.hpp"
#include "glsl/syntax/functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <unordered_set>

namespace tidemark::glsl {
namespace {

using text::Token;

/// Signatures of built-in functions, between semicolons: what it returns, then its parameters. F, I, U, B
/// stand for the scalar and the vectors of a kind, V, W, X, Y for its vectors alone, f, i, u, b for the
/// scalar (kinds: float, int, uint, bool); M for the float matrices, S for the square ones; > marks an `out`.
/// Capitals of one signature have one size. Any other word is a type.
struct Builtin {
    std::string_view names; ///< that have these signatures, between blanks
    std::string_view signatures;
};

constexpr Builtin k_builtins[] = {
    {"radians degrees sin cos tan asin acos sinh cosh tanh asinh acosh atanh exp log exp2 log2 sqrt "
     "inversesqrt "
     "floor trunc round roundEven ceil fract normalize dFdx dFdy fwidth",
     "F F"},
    {"atan", "F F; F F F"},
    {"pow reflect", "F F F"},
    {"refract", "F F F f"},
    {"faceforward", "F F F F"},
    {"abs sign", "F F; I I"},
    {"mod", "F F F; F F f"},
    {"modf", "F F >F"},
    {"min max", "F F F; F F f; I I I; I I i; U U U; U U u"},
    {"clamp", "F F F F; F F f f; I I I I; I I i i; U U U U; U U u u"},
    {"mix", "F F F F; F F F f; F F F B"},
    {"step", "F F F; F f F"},
    {"smoothstep", "F F F F; F f f F"},
    {"isnan isinf", "B F"},
    {"floatBitsToInt", "I F"},
    {"floatBitsToUint", "U F"},
    {"intBitsToFloat", "F I"},
    {"uintBitsToFloat", "F U"},
    {"length", "f F"},
    {"distance dot", "f F F"},
    {"cross", "vec3 vec3 vec3"},
    {"matrixCompMult", "M M M"},
    {"inverse", "S S"},
    {"determinant", "float S"},
    {"transpose",
     "S S; mat3x2 mat2x3; mat4x2 mat2x4; mat2x3 mat3x2; mat4x3 mat3x4; mat2x4 mat4x2; mat3x4 mat4x3"},
    {"outerProduct", "mat2 vec2 vec2; mat3 vec3 vec3; mat4 vec4 vec4; mat2x3 vec3 vec2; mat3x2 vec2 vec3; "
                     "mat2x4 vec4 vec2; mat4x2 vec2 vec4; mat3x4 vec4 vec3; mat4x3 vec3 vec4"},
    {"lessThan lessThanEqual greaterThan greaterThanEqual", "Y V V; Y W W; Y X X"},
    {"equal notEqual", "Y V V; Y W W; Y X X; Y Y Y"},
    {"any all", "b Y"},
    {"not", "Y Y"},
    {"texture", "vec4 sampler2D vec2; vec4 sampler2D vec2 f; vec4 samplerCube vec3; vec4 samplerCube vec3 f; "
                "vec4 sampler3D vec3; vec4 sampler3D vec3 f"},
    {"textureLod", "vec4 sampler2D vec2 f; vec4 samplerCube vec3 f; vec4 sampler3D vec3 f"},
    {"textureGrad", "vec4 sampler2D vec2 vec2 vec2; vec4 samplerCube vec3 vec3 vec3; "
                    "vec4 sampler3D vec3 vec3 vec3"},
    {"texelFetch", "vec4 sampler2D ivec2 i; vec4 sampler3D ivec3 i"},
    {"textureSize", "ivec2 sampler2D i; ivec2 samplerCube i; ivec3 sampler3D i"},
};

constexpr std::string_view k_matrices[] = {"mat2",   "mat3",   "mat4",   "mat2x3", "mat2x4",
                                           "mat3x2", "mat3x4", "mat4x2", "mat4x3"};
constexpr int k_square_matrices = 3;

/// The parts of `list` between `separator`s, blanks around them left out.
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

const Builtin* find_builtin(std::string_view name) {
    for (const Builtin& builtin : k_builtins)
        for (const std::string_view each : parts(builtin.names, ' '))
            if (each == name)
                return &builtin;
    return nullptr;
}

/// How many sizes the capitals of a signature go through.
int sizes(std::string_view signature) {
    if (signature.find('M') != std::string_view::npos)
        return int(std::size(k_matrices));
    if (signature.find('S') != std::string_view::npos)
        return k_square_matrices;
    if (signature.find_first_of("VWXY") != std::string_view::npos)
        return 3;
    return signature.find_first_of("FIUB") != std::string_view::npos ? 4 : 1;
}

/// The type that a word of a signature stands for at one of its sizes.
std::string type_of(std::string_view word, int size) {
    static constexpr std::string_view k_scalars[] = {"float", "int", "uint", "bool"};
    static constexpr std::string_view k_vectors[] = {"vec", "ivec", "uvec", "bvec"};
    if (word.size() > 1)
        return std::string(word);
    if (word == "M" || word == "S")
        return std::string(k_matrices[size]);
    if (const size_t kind = std::string_view("fiub").find(word); kind != std::string_view::npos)
        return std::string(k_scalars[kind]);
    if (const size_t kind = std::string_view("VWXY").find(word); kind != std::string_view::npos)
        return fmt::format("{}{}", k_vectors[kind], size + 2);
    const size_t kind = std::string_view("FIUB").find(word);
    return size == 0 ? std::string(k_scalars[kind]) : fmt::format("{}{}", k_vectors[kind], size + 1);
}

/// `TYPE st_NAME(TYPE a, …) { return NAME(a, …); }`; adds to `known` what it takes, and is empty where
/// something that takes the same is known already.
std::string forwarder(std::string_view name, std::string_view signature, int size,
                      std::set<std::string>& known) {
    const auto words = parts(signature, ' ');
    std::string types, parameters, arguments;
    for (size_t i = 1; i < words.size(); ++i) {
        const bool out = words[i].starts_with('>');
        const std::string type = type_of(words[i].substr(out ? 1 : 0), size);
        const char letter = char('a' + i - 1);
        const std::string_view comma = i > 1 ? ", " : "";
        types += type + " ";
        parameters += fmt::format("{}{}{} {}", comma, out ? "out " : "", type, letter);
        arguments += fmt::format("{}{}", comma, letter);
    }
    if (!known.insert(types).second)
        return {};
    return fmt::format("{0} {1}{2}({3}) {{ return {2}({4}); }}\n", type_of(words[0], size), k_renamed, name,
                       parameters, arguments);
}

/// What the author's functions of that name take, as `forwarder` writes it.
std::set<std::string> own_signatures(const std::vector<Function>& functions, std::string_view name) {
    std::set<std::string> signatures;
    for (const Function& function : functions) {
        std::string types;
        for (const Parameter& parameter : function.parameters)
            types += fmt::format("{}{} ", parameter.type, parameter.array ? "[]" : "");
        if (function.name == name)
            signatures.insert(types);
    }
    return signatures;
}

} // namespace

bool overloads_builtins(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    const auto functions = find_functions(tokens, preprocessed);
    return std::any_of(functions.begin(), functions.end(),
                       [](const Function& each) { return find_builtin(each.name) != nullptr; });
}

JoinedOverloads join_overloads(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    JoinedOverloads joined;
    const auto functions = find_functions(tokens, preprocessed);
    std::unordered_set<std::string_view> names;
    for (const Function& function : functions) {
        const Builtin* const builtin = find_builtin(function.name);
        if (!builtin || !names.insert(function.name).second)
            continue;
        std::set<std::string> known = own_signatures(functions, function.name);
        for (const std::string_view signature : parts(builtin->signatures, ';'))
            for (int size = 0; size < sizes(signature); ++size)
                joined.functions += forwarder(function.name, signature, size, known);
    }
    for (size_t i = 0; i + 1 < tokens.size(); ++i)
        if (tokens[i + 1].is("(") && names.contains(tokens[i].text) && !(i > 0 && tokens[i - 1].is(".")))
            joined.edits.push_back(
                {tokens[i].begin, tokens[i].end(), fmt::format("{}{}", k_renamed, tokens[i].text)});
    return joined;
}

} // namespace tidemark::glsl
