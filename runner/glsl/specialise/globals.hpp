// Lists the declarations at the outermost level of a text and finds those that `main` can reach. Works by
// name: a token with the name of a global reaches every global of that name, whatever it means there.
#pragma once

#include "glsl/syntax/parsed_text.hpp"

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace tidemark::glsl {

/// A function (definition or prototype) or a declaration at the outermost level.
struct Global {
    NodeId node = k_no_node;
    NodeId first = k_no_node; ///< its nodes are [first, node]
    std::vector<std::string_view> names{};
    /// Kept even if unused: main, inputs and outputs, and declarations whose initialisers have side effects.
    bool root = false;
};

/// Returns the globals in the order of the text.
std::vector<Global> find_globals(const ParsedText& text);

/// Returns for each global whether it is reached. `gone` tokens (empty: none) reach nothing; `kept` globals,
/// in the order of `globals`, are always reached.
std::vector<bool> find_reached(const ParsedText& text, const std::vector<Global>& globals,
                               const std::vector<bool>& gone, const std::vector<bool>& kept);

/// A variable's declaration, and how often its name is declared (in several scopes).
struct Variable {
    NodeId type = k_no_node;
    NodeId declared = k_no_node; ///< declarator or parameter
    unsigned times = 0;
};
using Variables = std::unordered_map<std::string_view, Variable>;

/// Returns the variables that the nodes [first, last] declare, without members of structures.
Variables find_variables(const ParsedText& text, NodeId first, NodeId last);

/// Returns the variables of the outermost level, each with its last declaration there.
Variables find_global_variables(const ParsedText& text, const std::vector<Global>& globals);

/// Returns the text with the values of global variables assigned at the start of `main`: glslang 12 crashes
/// when it writes debug information for a value outside of functions. If there is such a variable, macros are
/// expanded and #line directives keep the line numbers; otherwise the text is unchanged.
std::string assign_globals_in_main(const ParsedText& text);

} // namespace tidemark::glsl
