// Interactive controls of a report page, run by page/*.js. Returns HTML, which is hidden if scripts are off.
#pragma once

#include <string>

namespace tidemark::report {

/// Returns input fields for the largest allowed error and time.
std::string limits_form(const std::string& error_name);

/// Returns a comparison of two pictures with a divider. `reference` is a figure as HTML, shown alone if
/// scripts are off.
std::string comparison_form(const std::string& note, const std::string& reference);

} // namespace tidemark::report
