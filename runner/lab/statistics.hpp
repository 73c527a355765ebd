// Statistics of repeated measurements, as a report needs them. Pure; the same numbers give the same answer.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace tidemark::lab {

/// The value below which that part (0..1) of the values lies, linear between neighbours; NaN of none.
double quantile(std::vector<double> values, double part);
double quantile_of_sorted(std::span<const double> values, double part);
inline double median(std::vector<double> values) {
    return quantile(std::move(values), 0.5);
}

/// Where the truth lies in 95 of 100 cases.
struct Interval {
    double low = 0;
    double high = 0;

    bool contains(double value) const { return low <= value && value <= high; }
    bool overlaps(const Interval& other) const { return low <= other.high && other.low <= high; }
};

/// What a statistic of the whole says of its own uncertainty: the middle 95 % of its values on samples drawn
/// from `count` rows with replacement (percentile bootstrap, 1,000 samples, fixed seed). `of` gets the rows
/// drawn.
Interval bootstrap(size_t count, const std::function<double(const std::vector<size_t>& rows)>& of);
Interval bootstrap_median(const std::vector<double>& values);

/// Of a share that is known by a sample: in 95 of 100 cases no more than that (E. B. Wilson: Probable
/// inference, JASA 22, 1927).
double most_of_share(size_t some, size_t sampled);

/// Of fewer values there is no interval worth the name: it is NaN, and contains and overlaps nothing.
inline constexpr size_t k_fewest_runs = 5;

/// A time as a report gives it, milliseconds.
struct TimeSummary {
    size_t runs = 0;
    double median = 0;
    double smallest = 0;
    Interval confidence{}; ///< of the median
    double first_quartile = 0;
    double third_quartile = 0;
    /// Median of the last third over that of the first: a machine that warms up or gets company.
    double drift = 1;
    bool drifted = false; ///< by more than the spread of the values explains
};

/// `values` in the order of measurement.
TimeSummary summary_of(const std::vector<double>& values);

/// 0, 1, …, count - 1 shuffled; the same for the same seed, on every machine.
std::vector<size_t> shuffled(size_t count, unsigned seed);

} // namespace tidemark::lab
