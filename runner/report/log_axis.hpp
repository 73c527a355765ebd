// A logarithmic axis of a diagram: from values to pixels, and the values that stand beside it.
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

/// An axis that holds values from `least` to `most`, above 0, with some room beside them.
LogAxis log_axis(double least, double most, double first, double last);

/// Powers of ten where there are enough of them; else 1, 2 and 5 times these; else round numbers. At most
/// nine, within the axis, in order.
std::vector<double> ticks(const LogAxis& axis);

/// `0.05`, `200`, `10⁻⁵`, `2·10⁻⁵`.
std::string tick_text(double value);

} // namespace tidemark::report
