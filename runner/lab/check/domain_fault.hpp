// What is wrong where a value left its domain, in words.
#pragma once

#include "glsl/instrument/domains.hpp"

#include <string>

namespace tidemark::lab {

/// Of an index, a shift, a divisor, a texel or a conversion; else of a function of floats.
bool is_bound(const glsl::DomainSite& site, const glsl::DomainReading& reading);

/// "`a[i]`: index 7 outside of 0 to 4"; "pow of a negative number (-0.5".
std::string domain_sentence(const glsl::ParsedText& text, const glsl::DomainSite& site,
                            const glsl::DomainReading& reading);

/// `waves.glsl:12`; empty for a line of our own.
std::string place_of_site(const glsl::ParsedText& text, const glsl::DomainSite& site);

} // namespace tidemark::lab
