// The verdicts of `tidemark check -o` as a page for people: failures first, each with its picture and the
// command that draws it. Text out; pictures are read from where they were written.
#pragma once

#include "cli/check/verdicts.hpp"

#include <span>
#include <string>

namespace tidemark::cli {

std::string verdict_page(const ProbesRequest& request, std::span<const ProbeResult> all, double seconds);

} // namespace tidemark::cli
