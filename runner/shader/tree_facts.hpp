// Declarations of a syntax tree: structures, functions and kinds of variables. Keyed by name alone over the
// whole text: a name that is declared twice has the properties of both.
#pragma once

#include "shader/parsed_text.hpp"
#include "shader/vocabulary.hpp"

#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace tidemark::glsl {

/// Union of the properties of all variables of one name.
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

/// Properties of all overloads of one name.
struct FunctionFacts {
    std::vector<NodeId> definitions;
    bool returns_nothing = false; ///< true of at least one overload
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
    /// Returns whether a call of `name` writes argument `index`. Covers built-in functions.
    bool writes_argument(std::string_view name, size_t index) const;
    /// For each node: true of an expression that certainly has type int, uint or bool; false if unknown.
    std::vector<bool> surely_whole;
};

TreeFacts find_facts(const ParsedText& text);

/// Returns the name of a `type` node; empty for an unnamed structure.
std::string_view type_name(const ParsedText& text, NodeId type);
bool has_qualifier(const ParsedText& text, NodeId type, std::string_view qualifier);
/// Returns whether the type has a qualifier such as const, uniform, in, out or buffer: its variables need no
/// value from the text.
bool is_given(const ParsedText& text, NodeId type);
/// Returns whether a part of a declarator is one of its brackets, as in `a[3]`. Any other part is its value.
bool is_bracket(const ParsedText& text, NodeId part);
/// Counts the brackets of a declarator or parameter, including those of its type.
size_t dimensions(const ParsedText& text, NodeId type, NodeId declared);
/// Returns the base of a place: `a` of `a[i].x` and of `(a)`.
NodeId base_of(const SyntaxTree& tree, NodeId place);
/// Returns the expression inside parentheses: `a` of `((a))`.
NodeId without_brackets(const SyntaxTree& tree, NodeId expression);
/// Returns whether an expression assigns its first part: `=`, `+=` and similar, `++`, `--`.
bool is_change(const ParsedText& text, NodeId expression);
/// Returns the variables that this expression node assigns, or passes to a function that may write them. Does
/// not look at its subexpressions.
std::vector<std::string_view> names_set(const ParsedText& text, const TreeFacts& facts, NodeId expression);
/// Returns the name of the called function or constructor; empty for an array's constructor and `.length()`.
std::string_view called_name(const ParsedText& text, NodeId call);
/// Returns whether the node is a call of a function that the text defines.
bool calls_authors_function(const ParsedText& text, const TreeFacts& facts, NodeId id);

/// Returns whether an expression must stay constant: part of a `const` declaration, an array size, a case
/// label, or, in GLSL ES, the value of a global variable.
bool must_stay_constant(const ParsedText& text, NodeId id);

/// Returns the functions that calls from `main` reach, overloads taken together. For messages; to decide
/// which code can be removed use find_reached, which is more conservative: a mention of the name counts.
std::unordered_set<std::string_view> functions_of_main(const ParsedText& text, const TreeFacts& facts);

// Type of an expression, as far as declarations, built-in functions and the author's functions determine it.

/// Returns scalar, vector and matrix types. Returns nothing for other types, and for a name that its
/// function, or else the text outside of functions, declares with two types.
std::optional<ValueType> expression_type(const ParsedText& text, const TreeFacts& facts, NodeId expression);
/// Returns the overloads of the author's function that a call may mean, prototypes included: those with as
/// many parameters as it has arguments, of which the fewest are known to have another type.
std::vector<NodeId> called_definitions(const ParsedText& text, const TreeFacts& facts, NodeId call);

// Finds the single value of a variable that is initialised in its declaration and never changed.

class SingleValues {
public:
    SingleValues(const ParsedText& text, const TreeFacts& facts);

    /// Returns the initialiser of `name` if its function (or the global scope) declares it once and nothing
    /// assigns it; k_no_node otherwise, and for a node that is not a name. Variables in that expression may
    /// have changed since, and may have the same name (`float x = 2.0 * x`).
    NodeId of(NodeId name) const;

private:
    /// A name in a function; k_no_node stands for the global scope.
    using Place = std::pair<NodeId, std::string_view>;
    struct Declared {
        NodeId node = k_no_node; ///< declarator or parameter
        int times = 0;
    };

    const ParsedText& text_;
    std::map<Place, Declared> declared_{};
    std::set<Place> set_{};
    std::set<std::string_view> set_somewhere_{};
};

} // namespace tidemark::glsl
