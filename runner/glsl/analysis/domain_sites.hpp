// Finds the places of a text whose value can be undefined or decides a branch: calls of functions that have a
// domain, quotients, indices, shifts, divisions of whole numbers, fetched texels, conversions and
// comparisons. Changes nothing.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <string_view>
#include <vector>

namespace tidemark::glsl {

enum class DomainKind {
    function,   ///< a call of a float function
    quotient,   ///< `a / b`, `a /= b` of floats, unless the driver's overload resolution finds integers
    divisor,    ///< `a / b`, `a % b` and their assignments, of whole numbers
    shift,      ///< `a << b`, `a >> b` and their assignments
    index,      ///< `a[i]` of an array, a vector or a matrix
    fetch,      ///< texelFetch
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
/// has no domain, for anything else. The domains of functions are in glsl/syntax/builtin_functions.hpp.
std::string_view domain_name(const ParsedText& text, NodeId id);

} // namespace tidemark::glsl
