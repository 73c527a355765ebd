// A logarithmic axis of a diagram: maps values to pixels and chooses the tick values.
#pragma once

#include <string>
#include <vector>

namespace tidemark::report {

struct LogAxis {
    double low = 1;   ///< above 0
    double high = 10; ///< above low
    double first = 0; ///< the pixel of `low`
    double last = 1;  ///< the pixel of `high`; may lie before `first`

    double pixel(double value) const;
};

/// Returns an axis for values from `least` to `most`, both above 0, with a margin of 7 % at either end.
LogAxis log_axis(double least, double most, double first, double last);

/// Returns the ticks within the axis in increasing order: powers of ten if there are at least three, else 1,
/// 2 and 5 times these, else round numbers. At most ten.
std::vector<double> ticks(const LogAxis& axis);

/// Formats a tick: `0.05`, `200`, `10⁻⁵`, `2·10⁻⁵`.
std::string tick_text(double value);

} // namespace tidemark::report
