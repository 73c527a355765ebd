// The part of a study's page that one explores: diagrams with their legend and limits, a card for each point,
// two pictures side by side. HTML out; the script's part is runner/report/page.
#pragma once

#include "lab/study/report_html.hpp"

#include <string>

namespace tidemark::lab {

std::string explorer(const WorkPrecisionSet& set, const PageMedia& media);

/// The section that compares two pictures; empty: there are none.
std::string comparison(const PageMedia& media);

/// What the scripts read, as JSON.
std::string explorer_data(const WorkPrecisionSet& set);

} // namespace tidemark::lab
