// The report of a study: a folder that a person opens and programs read.
#pragma once

#include "base/output_path.hpp"
#include "lab/study/conduct.hpp"

namespace tidemark::lab {

/// Writes points.csv, study.json, the diagrams, the maps and report.html. What could not be made (no gnuplot)
/// is added to the remarks of the set; only a file that cannot be written is an error (ErrorCode::write).
Result<void> write_report(const OutputPath& folder, Findings& findings);

} // namespace tidemark::lab
