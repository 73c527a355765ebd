// Formats findings as a SARIF 2.1.0 log, which code scanning and editors read.
#pragma once

#include "cli/finding.hpp"
#include "cli/json_dump.hpp"

#include <span>

namespace tidemark::cli {

/// Returns a log with one run of this program. File names become URIs, relative if the name is.
Json sarif_log(std::span<const Finding> findings);

} // namespace tidemark::cli
