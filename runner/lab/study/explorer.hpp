// The interactive part of a study's page: diagrams with their legend and limits, a card for each point, two
// pictures side by side. Returns HTML; the scripts are in runner/report/page.
#pragma once

#include "lab/study/report_html.hpp"

#include <string>

namespace tidemark::lab {

std::string explorer(const WorkPrecisionSet& set, const PageMedia& media);

/// Returns the section that compares two pictures; empty if there are none.
std::string comparison(const PageMedia& media);

/// Returns the data for the scripts, as JSON.
std::string explorer_data(const WorkPrecisionSet& set);

} // namespace tidemark::lab
