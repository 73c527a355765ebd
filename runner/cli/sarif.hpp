// Findings as a SARIF 2.1.0 log, which code scanning and editors read.
#pragma once

#include "cli/finding.hpp"
#include "cli/json_dump.hpp"

#include <span>

namespace tidemark::cli {

/// One run of this program. Names of files become URIs, relative where the file's name is.
Json sarif_log(std::span<const Finding> findings);

} // namespace tidemark::cli
