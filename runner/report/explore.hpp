// Controls of a page that one explores, with page/*.js behind them. HTML out; hidden where no script runs.
#pragma once

#include <string>

namespace tidemark::report {

/// Fields for the most error and the most time allowed.
std::string limits_form(const std::string& error_name);

/// Two pictures of the page with a divider between them. `reference`: a figure, HTML, which stands there
/// alone without scripts.
std::string comparison_form(const std::string& note, const std::string& reference);

} // namespace tidemark::report
