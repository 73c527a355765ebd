// Table of GLSL's built-in functions: signatures, domain, and what a pass may do with a call. Every pass that
// depends on properties of built-in functions uses it.
#pragma once

#include "shader/vocabulary.hpp"

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Arguments of a component-wise function, for one component.
struct Arguments {
    double x = 0;
    double y = 0;
    double z = 0;
};

/// One condition under which a function is undefined: as GLSL, as C++, and as text for messages.
struct UndefinedWhere {
    std::string_view glsl; ///< condition on `float x`, `y`, `z`: "x<0.0"
    bool (*holds)(const Arguments&) = nullptr;
    std::string_view fault; ///< text that follows the function's name in a message: "of a negative number"
};

/// Arguments for which a function is undefined (GLSL 4.60, chapter 8). Describes the longest overload: for
/// atan the one with two arguments.
struct Domain {
    UndefinedWhere undefined[2]; ///< the second may be unused
    /// GLSL: distance to the undefined arguments; at most 0 where the function is undefined
    std::string_view room;
    std::string_view argument = "x"; ///< the argument to report

    /// Returns the condition that the arguments violate; nullptr if they are valid.
    const UndefinedWhere* broken(const Arguments& arguments) const;
};

enum class Trait : unsigned {
    none = 0,
    pure = 1,          ///< depends only on its arguments, and writes nothing
    costly = 2 | pure, ///< worth computing once instead of in every iteration of a loop
    inexact = 4,       ///< chapter 4.7.1 allows an error of more than half a unit in the last place
    derivative = 8,    ///< difference to neighbouring pixels
    implicit_lod = 16, ///< selects the mipmap level from such differences
    in_floats = 32,    ///< loses nothing if double arguments are rounded to floats: lookups, bits of floats
    sums_squares = 64, ///< works on whole vectors; overflows if the squares of their components do
};
constexpr Trait operator|(Trait a, Trait b) {
    return Trait(unsigned(a) | unsigned(b));
}

struct BuiltinFunction {
    std::string_view name;
    std::string_view signatures; ///< notation: see the table
    Trait traits = Trait::none;
    /// value for one component; nullptr if the function is not component-wise or not needed
    double (*value)(const Arguments&) = nullptr;
    const Domain* domain = nullptr; ///< nullptr if it is defined everywhere
    /// replacement in GLSL ES 3.00; empty if that version has the function
    std::string_view instead{};

    bool is(Trait trait) const { return (unsigned(traits) & unsigned(trait)) == unsigned(trait); }
    bool in_es() const { return instead.empty(); }
};

/// Returns the functions that a fragment shader of GLSL 4.50 may call, without deprecated names, in the order
/// of the specification.
std::span<const BuiltinFunction> builtin_functions();
/// Returns nullptr if there is no built-in function of that name.
const BuiltinFunction* find_builtin(std::string_view name);

struct BuiltinParameter {
    std::string_view type;
    bool written = false;  ///< `out`
    bool constant = false; ///< accepts only constant expressions
};

/// A signature with full type names.
struct BuiltinOverload {
    std::string_view result;
    std::vector<BuiltinParameter> parameters;
};

std::span<const BuiltinOverload> overloads_of(const BuiltinFunction& function);
size_t most_parameters(const BuiltinFunction& function);
bool takes_constants(const BuiltinFunction& function);

/// Returns the result type of the overload that accepts these arguments with the fewest conversions.
std::optional<ValueType> type_of_call(const BuiltinFunction& function, std::span<const ValueType> arguments);

/// Returns the arguments that the function writes, as bits; bit 0 is the first argument.
unsigned builtin_written_arguments(std::string_view name);

} // namespace tidemark::glsl
