// Variables of a text: their parts, zeros of their types, reads before a value, and values that nothing
// reads.
//
// Parts of a variable's type, down to single numbers, so that a place such as `s.light[2].xy` can be
// distinguished from the rest of `s`.
#pragma once

#include "shader/parsed_text.hpp"
#include "shader/tree_facts.hpp"

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace tidemark::glsl {

struct Shape {
    enum class Kind : unsigned char { scalar, vector, matrix, structure, array, unknown };
    struct Member;

    Kind kind = Kind::unknown;
    std::string_view type{}; ///< type name; an array has that of its elements; empty for an unnamed structure
    size_t length = 0;       ///< of a vector, an array or a matrix (columns); 0 if an array's is unknown
    const Shape* part = nullptr; ///< element of an array, column of a matrix, component of a vector
    std::vector<Member> members;
    /// Numbers that are tracked separately; 1 if they would exceed k_most_slots.
    unsigned slots = 1;
    bool whole = false; ///< its parts are not tracked separately
    size_t numbers = 0; ///< scalars in a full constructor; 0 if unknown, or if there is no constructor
    /// Statements that set it to zero one by one; 0 if it holds a sampler, or if they would be too many.
    size_t statements = 0;

    /// Returns whether it consists of numbers only, few enough to write a statement for each.
    bool can_be_zero() const { return statements > 0; }
    /// Returns whether its zero is the type name followed by `(0)`.
    bool is_plain() const { return kind == Kind::scalar || kind == Kind::vector || kind == Kind::matrix; }
};

struct Shape::Member {
    std::string_view name;
    const Shape* shape;
    unsigned first_slot;
};

/// One bit for each slot.
using Slots = uint64_t;
inline constexpr unsigned k_most_slots = 64;
inline Slots all_slots(unsigned count) {
    return count >= k_most_slots ? ~Slots(0) : (Slots(1) << count) - 1;
}

/// The part of a variable that an expression names.
struct Part {
    Slots slots = 0;
    const Shape* shape = nullptr; ///< nullptr if unknown, or for a swizzle of several components
    bool exact = true;            ///< the expression names all of `slots`, not only some of them
};

/// Keeps a reference to the text, which must outlive it.
class Shapes {
public:
    explicit Shapes(const ParsedText& text);

    /// Returns the shape of a declaration's type with one of its declarators; `declared` may be k_no_node.
    const Shape& of(NodeId type, NodeId declared);

    /// Returns the part of a variable of `shape` that `place` names; the base of `place` is the variable's
    /// name.
    Part part_of(const Shape& shape, NodeId place) const;

    /// Returns a whole number given by a literal, or by a global const of a whole type that is set to a
    /// literal.
    std::optional<long> number(size_t begin, size_t end) const;

private:
    const Shape& named(NodeId type);
    const Shape& structure(NodeId structure);
    const Shape& array_of(const Shape& element, std::optional<long> length);
    const Shape& plain(std::string_view type);
    const Shape& unknown(std::string_view type);
    std::vector<std::optional<long>> lengths(NodeId type, NodeId declared) const;
    Part member(const Part& of, std::string_view name) const;
    Part element(const Part& of, NodeId index) const;

    const ParsedText& text_;
    const SyntaxTree& tree_;
    std::deque<Shape> shapes_;
    std::unordered_map<std::string_view, const Shape*> plain_;
    std::unordered_map<NodeId, const Shape*> structures_;
    std::unordered_map<std::string_view, std::vector<NodeId>> structures_by_name_;
    std::unordered_map<std::string_view, long> constants_;
};

// Writes the zero of a type as GLSL: `0.0`, `vec3(0.0)`, `Hit(0.0, vec2[2](vec2(0.0), vec2(0.0)))`.

/// Returns the name of the shape's constructor: `float[2][3]`.
std::string constructor_of(const Shape& shape);

/// Returns nothing for a type without constructor, with more than 64 numbers, or with structures whose names
/// have another meaning somewhere in the text.
std::optional<std::string> zero_value(const Shape& shape, const TreeFacts& facts);

// Finds variables that may be read before they have a value. Follows all paths through every function,
// separately for each part of structures, vectors and small arrays, and follows global variables through
// calls. Sound: a part reported as assigned is assigned on every path that the text allows. Does not evaluate
// conditions, except those of simple loops.

/// A variable that is declared without a value although its type can have one.
struct UnsetVariable {
    NodeId type = k_no_node;
    NodeId declared = k_no_node; ///< declarator, or an `out` parameter
    const Shape* shape = nullptr;
    bool global = false;
    bool parameter = false;
    bool written = false;  ///< the text writes some part of it
    bool runs = true;      ///< `main` reaches its function
    bool doubtful = false; ///< written only by some overloads of a function
    /// First read of a part that some path leaves without a value; k_no_node if there is no such read.
    NodeId read = k_no_node;
    /// For a parameter: the `return` at which a part may have no value; the body if it is the end of the
    /// body.
    NodeId left = k_no_node;

    bool needs_value() const { return runs && (read != k_no_node || left != k_no_node); }
};

struct Assignment {
    std::vector<UnsetVariable> variables; ///< in text order
    /// Functions reached from `main` that return a value on some path, but may reach their end without a
    /// return.
    std::vector<NodeId> without_return;
};

/// Analyses the whole text. Without a `main`, every function counts as reached. `shapes` must belong to the
/// same text.
Assignment find_assignment(const ParsedText& text, const TreeFacts& facts, Shapes& shapes);

/// Names of variables, by function.
using NamesSet = std::map<std::string_view, std::set<std::string_view>>;

/// Returns the global variables that each function sets, those that it calls included.
NamesSet globals_set(const ParsedText& text, const TreeFacts& facts);
/// Adds the names that the node sets, itself or as a call of an author's function. `globals`: globals_set of
/// the text.
void add_names_set(const ParsedText& text, const TreeFacts& facts, const NamesSet& globals, NodeId id,
                   std::set<std::string_view>& names);

/// Returns whether the node, a number or a vector of floats, is only read.
bool is_number_read(const ParsedText& text, const TreeFacts& facts, NodeId id);

/// Returns the channels that a sampler may stand for, as bits: of a parameter, those that calls give it.
/// `depth`: calls that were followed.
int channels_of(const ParsedText& text, const TreeFacts& facts, NodeId sampler, int depth = 0);

// Finds work that no compiler leaves in a program, because nothing reads its result.

/// Returns for each expression whether the colour of mainImage may depend on it. By name, for each function
/// as a whole: a variable that is read anywhere in its function counts as read after each assignment.
std::vector<bool> find_needed(const ParsedText& text, const TreeFacts& facts);

/// For whom `find_known` looks: a compiler knows the values that it computes itself.
enum class KnownTo {
    compilers,
    frame,       ///< also what is computed of uniforms, which has one value for the frame
    swiftshader, ///< compilers of SwiftShader, which compute few functions
};

/// Returns for each expression whether its value is known: literals, variables that get one such value,
/// parameters that get only such values, and what is computed of these.
std::vector<bool> find_known(const ParsedText& text, const TreeFacts& facts, KnownTo whom);

} // namespace tidemark::glsl
