// The functions that a text whose domains are watched calls, as GLSL: one overload for each type.
#pragma once

#include "glsl/analysis/domain_sites.hpp"

#include <span>
#include <string>
#include <string_view>

namespace tidemark::glsl {

struct DomainPreludeOptions {
    std::string prefix;         ///< of every name
    size_t objectives = 0;      ///< that are followed
    size_t first_objective = 0; ///< word
};

/// In front of the text; what `sites` do not need is left out.
std::string domain_prelude(const ParsedText& text, std::span<const DomainSite> sites,
                           const DomainPreludeOptions& options);

/// Behind the text, whose own `main` is `$main`.
std::string domain_main(std::string_view prefix);

} // namespace tidemark::glsl
