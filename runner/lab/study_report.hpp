// The report of a study: a folder to open in a browser and to read by programs.
#pragma once

#include "base/file.hpp"
#include "lab/conduct.hpp"

namespace tidemark::lab {

/// Writes points.csv, study.json, the maps and report.html. Fails with ErrorCode::write if a file cannot be
/// written.
Result<void> write_report(const OutputPath& folder, const Findings& findings);

} // namespace tidemark::lab
