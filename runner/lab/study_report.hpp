// The report of a study: a folder with its page, one HTML file that needs no network and is complete without
// scripts.
#pragma once

#include "base/file.hpp"
#include "lab/conduct.hpp"
#include "lab/work_precision.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

struct PagePicture {
    std::string label;  ///< for example "picture" or "FLIP"
    std::string file;   ///< in the report's folder
    std::string source; ///< `data:image/png;base64,…`; empty: the page links to the file
};

/// The pictures of the page.
struct PageMedia {
    std::string view; ///< name of the view that the pictures show
    std::optional<PagePicture> reference;
    std::vector<std::vector<PagePicture>> points; ///< one list for each point; empty if no point has any
};

std::string to_html(const WorkPrecisionSet& set, const PageMedia& media);

// Formats a study's numbers for the page, with units and intervals. Returns HTML.

/// Three digits, including trailing zeros, so that columns align; a dash if the value is not known.
std::string number(double value);

/// For example `0.612 [0.408, 0.705]`, in milliseconds.
std::string time_text(const TimeSummary& time);

/// For example `0.0123 ± 0.0001`: includes the truth's own error if it is known.
std::string error_text(const WorkPrecisionSet& set, const Outcome& outcome);

/// Writes the report of a study, a folder to open in a browser and to read by programs: points.csv,
/// study.json, the maps and report.html. Fails with ErrorCode::write if a file cannot be written.
Result<void> write_report(const OutputPath& folder, const Findings& findings);

} // namespace tidemark::lab
