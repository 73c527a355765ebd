// The page of `tidemark check -o`: failures first, each with its picture and the command that draws it.
// Returns text; pictures are read from the files written before.
#pragma once

#include "cli/check/verdicts.hpp"

#include <span>
#include <string>

namespace tidemark::cli {

std::string verdict_page(const ProbesRequest& request, std::span<const ProbeResult> all, double seconds);

} // namespace tidemark::cli
