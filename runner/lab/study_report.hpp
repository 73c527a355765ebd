// Diagrams of a study as gnuplot scripts: error over time and error over work. Only writes the text; the
// report runs it.
#pragma once

#include "base/file.hpp"
#include "lab/conduct.hpp"
#include "lab/work_precision.hpp"

#include <string>

namespace tidemark::lab {

/// Quantity on the horizontal axis; the error is on the vertical one.
enum class Across { time, work };

/// Returns a script that, run in the report's folder, writes `NAME.svg` and `NAME.png`. Points of error 0
/// have no place on a logarithmic axis and are left out; the result is empty if no point is left.
std::string diagram_script(const WorkPrecisionSet& set, Across across, const std::string& name);

// The report of a study: a folder to open in a browser and to read by programs.

/// Writes points.csv, study.json, the diagrams, the maps and report.html. Parts that could not be made (no
/// gnuplot) are added to the remarks of the set; only a file that cannot be written is an error
/// (ErrorCode::write).
Result<void> write_report(const OutputPath& folder, Findings& findings);

} // namespace tidemark::lab
