// Writes the GLSL functions that a text with watched domains calls: one overload per type.
#pragma once

#include "glsl/analysis/domain_sites.hpp"

#include <span>
#include <string>
#include <string_view>

namespace tidemark::glsl {

struct DomainPreludeOptions {
    std::string prefix;         ///< prefix of every name
    size_t objectives = 0;      ///< number of objectives
    size_t first_objective = 0; ///< buffer index of the first objective
};

/// Returns the functions to put before the text, limited to those that `sites` need.
std::string domain_prelude(const ParsedText& text, std::span<const DomainSite> sites,
                           const DomainPreludeOptions& options);

/// Returns the `main` to put after the text, whose own `main` is renamed to `$main`.
std::string domain_main(std::string_view prefix);

} // namespace tidemark::glsl
