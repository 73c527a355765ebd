// The page of a study: one HTML file that needs no network, and is complete without scripts. Returns text.
#pragma once

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

// The interactive part of a study's page: diagrams with their legend and limits, a card for each point, two
// pictures side by side. Returns HTML; the scripts are in runner/report/page.

std::string explorer(const WorkPrecisionSet& set, const PageMedia& media);

/// Returns the section that compares two pictures; empty if there are none.
std::string comparison(const PageMedia& media);

/// Returns the data for the scripts, as JSON.
std::string explorer_data(const WorkPrecisionSet& set);

} // namespace tidemark::lab
