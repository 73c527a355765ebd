// Finds undefined results in a text: NaN, domains, edges, derivatives, variables without a value.
//
// Finds the operations of a text that can make a NaN or an infinity from finite values.
#pragma once

#include "shader/parsed_text.hpp"
#include "shader/tree_facts.hpp"
#include "shader/variables.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Returns whether the node is float arithmetic or a call with a result, so that its value can be passed
/// through an inserted function.
bool is_float_operation(const ParsedText& text, const TreeFacts& facts, NodeId id);

// Finds the places of a text whose value can be undefined or decides a branch: calls of functions that have a
// domain, quotients, indices, shifts, divisions of whole numbers, fetched texels, conversions and
// comparisons. Changes nothing.

enum class DomainKind {
    function, ///< a call of a float function
    quotient, ///< `a / b`, `a /= b` of floats, unless the driver's overload resolution finds integers
    divisor,  ///< `a / b`, `a % b` and their assignments, of whole numbers
    negative, ///< the same: `a` may be negative, where `%` is undefined and the rounding of `/` is not stated
    whole,    ///< `mod(a, b)` and `a / b` under floor and similar, of floats, which jump at whole quotients
    shift,    ///< `a << b`, `a >> b` and their assignments
    index,    ///< `a[i]` of an array, a vector or a matrix
    fetch,    ///< texelFetch
    conversion, ///< one argument of `int(x)`, `uvec2(x, y)`
    comparison, ///< `a < b` and similar: no domain, but it decides a branch
};

struct DomainSite {
    NodeId node = k_no_node;
    DomainKind kind = DomainKind::function;
    bool to_unsigned = false; ///< for conversions
};

/// The kinds of site to look for.
enum class DomainScope { floats, everything };

/// Returns the sites in the order of the tree, inner ones first, without those that literals in the text
/// prove defined.
std::vector<DomainSite> find_domain_sites(const ParsedText& text, const TreeFacts& facts, DomainScope scope);

/// Name of the division operator's domain. Section 4.7.1 of the specification defines x / 0, but not 0 / 0.
inline constexpr std::string_view k_quotient = "quotient";

/// Returns "pow" for a call of pow and k_quotient for a / b and a /= b. Returns an empty text, or a name that
/// has no domain, for anything else. The domains of functions are in shader/builtin_functions.hpp.
std::string_view domain_name(const ParsedText& text, NodeId id);

// Finds calls with edges in the wrong order, and look-ups whose coordinates jump.

/// A call of clamp or smoothstep whose low edge is above its high one by the numbers of the text, or, of
/// smoothstep, equal to it. Both are undefined in GLSL.
struct WrongEdges {
    NodeId call = k_no_node;
    bool equal = false;
};
/// Returns such calls in functions reachable from `main`, in the order of the text.
std::vector<WrongEdges> find_wrong_edges(const ParsedText& text, const TreeFacts& facts);

/// A look-up that chooses its mipmap by the difference to neighbouring pixels, where that difference is that
/// of a jump: the coordinates have the whole or the fractional part of something, or an angle.
struct JumpingLookUp {
    NodeId call = k_no_node;
    std::string jump;   ///< the name of the function that jumps
    std::string smooth; ///< the coordinates without the jumps: they have the same derivatives elsewhere
    std::string
        other_angle; ///< the same with the jump of an angle at another place; empty: there is no angle
};
/// Returns such look-ups in functions reachable from `main`. Leaves out those whose coordinates cannot be
/// written without the jumps, and those in which a whole and a fractional part may add up to a smooth value.
std::vector<JumpingLookUp>
find_jumping_look_ups(const ParsedText& text, const TreeFacts& facts,
                      const std::function<bool(std::string_view sampler)>& has_mipmaps);

// Finds derivatives, explicit or by a texture look-up that chooses its mipmap, at places that neighbouring
// pixels may not reach. They are undefined there, because a derivative is a difference to a neighbour.

/// The place that separates the pixels that reach a node from their neighbours.
struct DivergentBranch {
    NodeId at = k_no_node; ///< a condition; with `exit` a return, discard, continue, or a call that discards
    bool exit = false;     ///< the node comes after `at`, where some pixels left
    bool called = false;   ///< the separation happens before a call of the function that holds the node
};

struct Divergent {
    NodeId call = k_no_node;
    DivergentBranch branch;
    /// Neighbours on other paths have the values that the coordinates consist of: these are from before the
    /// branch, or sums and multiples of the pixel's place. Or a bias always selects the base level. Undefined
    /// in GLSL all the same.
    bool harmless = false;
};

/// Returns such calls in functions reachable from `main`, in the order of the text. A value may differ
/// between pixels if gl_FragCoord contributes to it in any way; variables are distinguished by name alone.
/// GLSL 4.60, 6.4: "subsequent implicit or explicit derivatives are undefined when this control flow is
/// non-uniform", for a discard as for a return.
std::vector<Divergent> find_divergent(const ParsedText& text, const TreeFacts& facts,
                                      const std::function<bool(std::string_view sampler)>& has_mipmaps);

// Finds variables that may be read before they have a value, and functions that may end without a return
// value. Both are undefined in GLSL; ShaderToy's site uses zeros.

struct Unassigned {
    enum class Why : unsigned char {
        never,            ///< nothing writes the variable
        on_some_way,      ///< some path to the read leaves it, or a part of it, unset
        not_given,        ///< an `out` parameter that nothing writes
        left_on_some_way, ///< an `out` parameter that some path to the function's end leaves unset
        no_return         ///< some path to the function's end returns no value
    };
    Why why = Why::never;
    NodeId what = k_no_node; ///< declarator, parameter or function
    NodeId at = k_no_node;   ///< the first read, the `return` or body, or the function itself
};

/// Returns the faults in functions reachable from `main`, in the order of the text. Reports nothing if
/// overloads leave it open whether an argument is written.
std::vector<Unassigned> find_unassigned(const ParsedText& text, const TreeFacts& facts);

} // namespace tidemark::glsl
