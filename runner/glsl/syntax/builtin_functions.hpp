// GLSL's built-in functions, one row each: what they take and give, where they are undefined, what a pass may
// do with a call. Every pass that asks something of a built-in function asks it here.
#pragma once

#include "glsl/syntax/types.hpp"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Of a function that works number by number: its arguments at one component.
struct Arguments {
    double x = 0;
    double y = 0;
    double z = 0;
};

/// One way to be undefined: the same condition for shaders and for the CPU, and its words for people.
struct UndefinedWhere {
    std::string_view glsl; ///< of `float x`, `y`, `z`: "x<0.0"
    bool (*holds)(const Arguments&) = nullptr;
    std::string_view fault; ///< behind the function's name: "of a negative number"
};

/// Where a function is undefined (GLSL 4.60, chapter 8). Of its longest overload: atan of two arguments.
struct Domain {
    UndefinedWhere undefined[2];     ///< there may be only one
    std::string_view room;           ///< GLSL: how far it is to there; not above 0 where it is undefined
    std::string_view argument = "x"; ///< the argument that is written down

    /// What is wrong with the arguments; nullptr: nothing.
    const UndefinedWhere* broken(const Arguments& arguments) const;
};

enum class Trait : unsigned {
    none = 0,
    pure = 1,          ///< computes from its arguments alone, and writes nothing
    costly = 2 | pure, ///< worth to be computed once instead of in every turn of a loop
    inexact = 4,       ///< chapter 4.7.1 lets a GPU be off by more than half a unit in the last place
    derivative = 8,    ///< a difference to the neighbouring pixels
    implicit_lod = 16, ///< takes the mipmap's level from such differences
    in_floats = 32,    ///< loses nothing where the arguments become floats: lookups, bits of floats
    sums_squares = 64, ///< of whole vectors: overflows where the squares of their numbers do
};
constexpr Trait operator|(Trait a, Trait b) {
    return Trait(unsigned(a) | unsigned(b));
}

struct BuiltinFunction {
    std::string_view name;
    std::string_view signatures; ///< the notation stands above the table
    Trait traits = Trait::none;
    double (*value)(const Arguments&) = nullptr; ///< where it works number by number; not of all
    const Domain* domain = nullptr;              ///< nullptr: defined everywhere
    std::string_view instead{};                  ///< of it in GLSL ES 3.00; empty: that has it

    bool is(Trait trait) const { return (unsigned(traits) & unsigned(trait)) == unsigned(trait); }
    bool in_es() const { return instead.empty(); }
};

/// What a fragment shader of GLSL 4.50 may call, of its older names none; in the order of the specification.
std::span<const BuiltinFunction> builtin_functions();
/// nullptr: there is none of that name.
const BuiltinFunction* find_builtin(std::string_view name);

struct BuiltinParameter {
    std::string_view type;
    bool written = false;  ///< `out`
    bool constant = false; ///< takes constant expressions only
};

/// A signature with its types spelled out.
struct BuiltinOverload {
    std::string_view result;
    std::vector<BuiltinParameter> parameters;
};

std::span<const BuiltinOverload> overloads_of(const BuiltinFunction& function);
size_t most_parameters(const BuiltinFunction& function);
bool takes_constants(const BuiltinFunction& function);

/// Of the overload that takes these arguments with the fewest conversions.
std::optional<ValueType> type_of_call(const BuiltinFunction& function, std::span<const ValueType> arguments);

/// The arguments that this function writes through, a bit each, the first one's the lowest.
unsigned builtin_written_arguments(std::string_view name);

} // namespace tidemark::glsl
