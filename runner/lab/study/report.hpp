// The report of a study: a folder to open in a browser and to read by programs.
#pragma once

#include "base/output_path.hpp"
#include "lab/study/conduct.hpp"

namespace tidemark::lab {

/// Writes points.csv, study.json, the diagrams, the maps and report.html. Parts that could not be made (no
/// gnuplot) are added to the remarks of the set; only a file that cannot be written is an error
/// (ErrorCode::write).
Result<void> write_report(const OutputPath& folder, Findings& findings);

} // namespace tidemark::lab
