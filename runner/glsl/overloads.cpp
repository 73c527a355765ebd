#include "glsl/overloads.hpp"

#include "glsl/rewrite.hpp"
#include "glsl/syntax/builtin_functions.hpp"
#include "glsl/syntax/functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_set>

namespace tidemark::glsl {
namespace {

using text::Token;

/// Returns the built-in function that `join_overloads` handles; nullptr if none. Functions that take constant
/// expressions are left out, because a generated function cannot pass them on.
const BuiltinFunction* joined(std::string_view name) {
    const BuiltinFunction* const function = find_builtin(name);
    return function && function->in_es() && !takes_constants(*function) ? function : nullptr;
}

/// Returns `TYPE st_NAME(TYPE a, …) { return NAME(a, …); }` and adds its parameter types to `known`; empty if
/// they are in `known` already.
std::string forwarder(std::string_view name, const BuiltinOverload& overload, std::set<std::string>& known) {
    std::string types, parameters, arguments;
    for (const BuiltinParameter& parameter : overload.parameters) {
        const char letter = char('a' + (&parameter - overload.parameters.data()));
        const std::string_view comma = types.empty() ? "" : ", ";
        types += fmt::format("{} ", parameter.type);
        parameters +=
            fmt::format("{}{}{} {}", comma, parameter.written ? "out " : "", parameter.type, letter);
        arguments += fmt::format("{}{}", comma, letter);
    }
    if (!known.insert(types).second)
        return {};
    return fmt::format("{0} {1}{2}({3}) {{ return {2}({4}); }}\n", overload.result, k_renamed, name,
                       parameters, arguments);
}

/// Returns the parameter types of the author's functions of that name, in the format of `forwarder`.
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
                       [](const Function& each) { return joined(each.name) != nullptr; });
}

JoinedOverloads join_overloads(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    JoinedOverloads result;
    const auto functions = find_functions(tokens, preprocessed);
    std::unordered_set<std::string_view> names;
    for (const Function& function : functions) {
        const BuiltinFunction* const builtin = joined(function.name);
        if (!builtin || !names.insert(function.name).second)
            continue;
        std::set<std::string> known = own_signatures(functions, function.name);
        for (const BuiltinOverload& overload : overloads_of(*builtin))
            result.functions += forwarder(function.name, overload, known);
    }
    for (size_t i = 0; i + 1 < tokens.size(); ++i)
        if (tokens[i + 1].is("(") && names.contains(tokens[i].text) && !(i > 0 && tokens[i - 1].is(".")))
            result.edits.push_back(
                {tokens[i].begin, tokens[i].end(), fmt::format("{}{}", k_renamed, tokens[i].text)});
    return result;
}

} // namespace tidemark::glsl
