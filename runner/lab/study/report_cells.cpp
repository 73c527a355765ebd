#include "lab/study/report_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {

std::string number(double value) {
    if (!std::isfinite(value))
        return std::isinf(value) ? "&infin;" : "&ndash;";
    if (value == 0)
        return "0";
    const int power = int(std::floor(std::log10(std::abs(value))));
    return power < -4 || power > 6 ? fmt::format("{:.2e}", value)
                                   : fmt::format("{:.{}f}", value, std::max(2 - power, 0));
}

std::string time_text(const TimeSummary& time) {
    const std::string interval =
        time.runs < k_fewest_runs
            ? fmt::format("[{} rounds]", time.runs)
            : fmt::format("[{}, {}]", number(time.confidence.low), number(time.confidence.high));
    return fmt::format("{} {}{}", number(time.median), interval, time.drifted ? " drift" : "");
}

std::string error_text(const WorkPrecisionSet& set, const Outcome& outcome) {
    const auto& own = standard_of(set).uncertainty;
    return number(error_of(set, outcome)) + (own ? " &plusmn; " + number(*own) : "");
}

} // namespace tidemark::lab
