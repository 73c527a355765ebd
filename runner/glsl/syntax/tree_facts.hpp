// What a syntax tree declares: structures, functions and what the names of variables stand for. By name
// alone, over the whole text: where a name is declared twice, it may be either.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/types.hpp"

#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tidemark::glsl {

/// A name with all that it is declared as.
struct Meanings {
    bool floating = false;
    bool whole = false;
    bool sampler = false;
    bool structure = false;
    bool array = false;
    bool uniform = false;
    bool constant = false;

    bool only_whole() const { return whole && !floating && !structure && !sampler; }
};

/// The overloads of one name, taken together.
struct FunctionFacts {
    std::vector<NodeId> definitions;
    bool returns_nothing = false; ///< some overload
    bool returns_array = false;
    unsigned written_arguments = 0; ///< bit i: argument i is `out` or `inout`
};

struct StructureMember {
    std::string_view type;
    std::string_view name;
    bool array = false;
};

struct TreeFacts {
    std::unordered_map<std::string_view, std::vector<StructureMember>> structures;
    std::unordered_map<std::string_view, FunctionFacts> functions;
    std::unordered_map<std::string_view, Meanings> names;

    bool is_type(std::string_view word) const;
    const FunctionFacts* function(std::string_view name) const;
    /// Whether a call of `name` writes through argument `index`, built-in functions included.
    bool writes_argument(std::string_view name, size_t index) const;
    /// Of each node: an expression of ints, uints or bools. One of which this is not true may still be whole.
    std::vector<bool> surely_whole;
};

TreeFacts find_facts(const ParsedText& text);

/// The word of a `type` node that names it; empty for a structure without a name.
std::string_view type_name(const ParsedText& text, NodeId type);
bool has_qualifier(const ParsedText& text, NodeId type, std::string_view qualifier);
/// Whether a variable of that type gets its content from elsewhere, or never another one.
bool is_given(const ParsedText& text, NodeId type);
/// Whether a part of a declarator is a bracket of its own, as in `a[3]`. Any other part is its value.
bool is_bracket(const ParsedText& text, NodeId part);
/// How many brackets a declarator or parameter has, those of its type included.
size_t dimensions(const ParsedText& text, NodeId type, NodeId declared);
/// The `a` of `a[i].x` and of `(a)`: what stands in the middle of brackets, members and parentheses.
NodeId base_of(const SyntaxTree& tree, NodeId place);
/// The `a` of `((a))`.
NodeId without_brackets(const SyntaxTree& tree, NodeId expression);
/// Whether an expression sets its first part: by `=`, `+=` and their kind, `++` and `--`.
bool is_change(const ParsedText& text, NodeId expression);
/// The variables that an expression itself, its parts aside, sets, or hands to a function that may.
std::vector<std::string_view> names_set(const ParsedText& text, const TreeFacts& facts, NodeId expression);
/// The name that a call calls, for functions and constructors alike; empty for an array's constructor and for
/// `.length()`.
std::string_view called_name(const ParsedText& text, NodeId call);

/// Whether an expression must stay constant: part of a `const` declaration, an array's size or a case label;
/// or, in GLSL ES, the value of a global variable.
bool must_stay_constant(const ParsedText& text, NodeId id);

/// The functions that `main` comes to by calls, overloads taken together: to tell authors about. What may be
/// taken away is find_reached's to say (globals.hpp), which a word is enough for.
std::unordered_set<std::string_view> functions_of_main(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
