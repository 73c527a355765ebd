// The places of a text whose value is undefined somewhere, and those where it goes one way or another: calls
// of functions that have a domain, quotients, indices, shifts, divisions of whole numbers, fetched texels,
// conversions, and comparisons. Finds them; changes nothing.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <string_view>
#include <vector>

namespace tidemark::glsl {

enum class DomainKind {
    function,   ///< of floats: the call
    quotient,   ///< `a / b`, `a /= b`; of floats, unless the driver's types say otherwise
    divisor,    ///< `a / b`, `a % b` and their assignments, of whole numbers
    shift,      ///< `a << b`, `a >> b` and their assignments
    index,      ///< `a[i]` of an array, a vector or a matrix
    fetch,      ///< texelFetch
    conversion, ///< one argument of `int(x)`, `uvec2(x, y)`
    comparison, ///< `a < b` and its kind: no domain, but two ways to go
};

struct DomainSite {
    NodeId node = k_no_node;
    DomainKind kind = DomainKind::function;
    bool to_unsigned = false; ///< of a conversion
};

/// Which of them to look for.
enum class DomainScope { floats, everything };

/// In the order of the tree: what is inside comes first. Those that the text itself settles are left out.
std::vector<DomainSite> find_domain_sites(const ParsedText& text, const TreeFacts& facts, DomainScope scope);

/// A function of floats with a domain; the sentences are those of GLSL 4.50, chapter 8. One number at a time.
struct Domain {
    std::string_view name;
    std::string_view arguments; ///< of its overload for floats
    std::string_view undefined;
    std::string_view room;     ///< how far it is to there: not above 0 where it is undefined
    std::string_view argument; ///< the argument that is written down
    std::string_view fault;
};
const Domain* domain_of(std::string_view name);

inline constexpr std::string_view k_normalize = "normalize";
/// Of the operator. Of x / 0 chapter 4.7.1 tells what it is, of 0 / 0 it does not.
inline constexpr std::string_view k_quotient = "quotient";

/// "pow", or "quotient" of a / b and a /= b; what else has no domain gives nothing, or another name.
std::string_view domain_name(const ParsedText& text, NodeId id);

} // namespace tidemark::glsl
