// What the variables of a text are made of: the parts of a type, down to single numbers, so that a place such
// as `s.light[2].xy` can be told from the rest of `s`.
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
    std::string_view type{}; ///< its name; of an array that of its elements; empty: a structure without one
    size_t length = 0;       ///< of a vector, an array, a matrix (columns); 0: an array's is not known
    const Shape* part = nullptr; ///< element of an array, column of a matrix, component of a vector
    std::vector<Member> members;
    unsigned slots =
        1; ///< numbers that are told apart; where they would be too many, the whole counts as one
    bool whole = false; ///< its parts are not told apart
    size_t numbers = 0; ///< values that a constructor of it takes in all; 0: not known, or no constructor
    size_t statements =
        0; ///< that set it to zero one by one; 0: it holds a sampler, or they would be too many

    /// Made of numbers alone, and of few enough to write a statement for each.
    bool can_be_zero() const { return statements > 0; }
    /// A word and `(0)` make a zero of it.
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

/// A part of a variable that an expression names.
struct Part {
    Slots slots = 0;
    const Shape* shape = nullptr; ///< nullptr: of no more than one number
    bool exact = true;            ///< all of `slots`, and nothing less
};

/// Refers to the text, which must outlive it.
class Shapes {
public:
    explicit Shapes(const ParsedText& text);

    /// Of what a declaration's type and one of its declarators make together; `declared` may be none.
    const Shape& of(NodeId type, NodeId declared);

    /// The part of a variable of `shape` that `place` names, its base being the variable's name.
    Part part_of(const Shape& shape, NodeId place) const;

    /// A whole number that the text alone gives: a literal, a global `const int` made of one.
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
