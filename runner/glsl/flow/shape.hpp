// Parts of a variable's type, down to single numbers, so that a place such as `s.light[2].xy` can be
// distinguished from the rest of `s`.
#pragma once

#include "glsl/syntax/parsed_text.hpp"

#include <cstdint>
#include <deque>
#include <optional>
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

} // namespace tidemark::glsl
