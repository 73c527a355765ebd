// What stands at the outermost level of a text, and what of it the program can reach from `main`. By name: a
// word that is the name of something reaches all of that name, whatever it means where it stands.
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
    /// Stays, whoever names it: main, what comes in and goes out, what changes other things when it is set.
    bool root = false;
};

/// In the order of the text.
std::vector<Global> find_globals(const ParsedText& text);

/// `gone` words (empty: none) reach nothing; of `kept` globals, in their order, all is reached.
std::vector<bool> find_reached(const ParsedText& text, const std::vector<Global>& globals,
                               const std::vector<bool>& gone, const std::vector<bool>& kept);

/// A variable by its declarations, which may be several (in several scopes).
struct Variable {
    NodeId type = k_no_node;
    NodeId declared = k_no_node; ///< declarator or parameter
    unsigned times = 0;
};
using Variables = std::unordered_map<std::string_view, Variable>;

/// The variables that the nodes [first, last] declare; members of structures are none.
Variables find_variables(const ParsedText& text, NodeId first, NodeId last);

/// Those of the outermost level, by the last of their declarations there.
Variables find_global_variables(const ParsedText& text, const std::vector<Global>& globals);

/// The text with the values of global variables assigned at the start of `main`: glslang 12 crashes where it
/// writes debug information of a value outside of functions. Where there is such a variable, macros are
/// expanded and #line directives keep the numbers of the lines; otherwise the text is returned as it is.
std::string assign_globals_in_main(const ParsedText& text);

} // namespace tidemark::glsl
