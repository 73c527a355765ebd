// A shader that watches where its built-in functions are undefined: `pow` of a negative number, `sqrt`,
// `log`, `acos` and their kind outside of their domain, `normalize` of nothing, `smoothstep` with equal
// edges, `mod` by zero; and the quotient of two zeros. Text in, text out. It counts such calls in a buffer of
// words, and can be told to take another value for what such a call gives, as another GPU may.
#pragma once

#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

struct DomainWatch {
    std::string text;
    std::vector<NodeId> calls; ///< that may be undefined: number i has the words from i * k_domain_words
    /// int: the call that gives another value where it is undefined, while all others give 0 there; one
    /// beyond the last: all give 0; -1: all give what the driver makes of it.
    std::string number_uniform;
    std::string value_uniform; ///< float: that value
};

/// Words of a call: how often it was undefined, the complement of the first pixel (x + y * width) that saw
/// it, and the argument farthest from zero, as bits with the sign behind the last one.
inline constexpr size_t k_domain_words = 3;

/// `facts` are the text's own; `width` is the picture's. Calls whose arguments stand in the text are left
/// out.
DomainWatch watch_domains(const ParsedText& text, const TreeFacts& facts, int width);

/// "pow", or "quotient" of a / b and a /= b; what else has no domain gives nothing, or another name.
std::string_view domain_name(const ParsedText& text, NodeId id);

/// "of a negative number": what is wrong with the argument where a call of `name` is undefined.
std::string_view domain_fault(std::string_view name);

} // namespace tidemark::glsl
