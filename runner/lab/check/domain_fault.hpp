// Describes, for messages, a value that left a function's or operator's domain. Readings of an instrumented
// text in, text out.
#pragma once

#include "glsl/instrument/domains.hpp"

#include <string>

namespace tidemark::lab {

/// Returns whether the site is an index, a shift, a whole-number divisor, a texel or a conversion rather than
/// a function of floats.
bool is_bound(const glsl::DomainSite& site, const glsl::DomainReading& reading);

/// Returns the start of a message, such as "`a[i]`: index 7 outside of 0 to 4" or, with an open parenthesis
/// that the caller closes, "pow of a negative number (-0.5".
std::string domain_sentence(const glsl::ParsedText& text, const glsl::DomainSite& site,
                            const glsl::DomainReading& reading);

/// Returns `waves.glsl:12`; empty for a line that Tidemark generated.
std::string place_of_site(const glsl::ParsedText& text, const glsl::DomainSite& site);

} // namespace tidemark::lab
