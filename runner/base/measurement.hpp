// Long jobs: progress callbacks, timing, work on all cores, sampling, statistics.
//
// Progress and cancellation callbacks for long jobs.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace tidemark::lab {

/// Called between two pieces of work; returns false to stop.
using KeepGoing = std::function<bool()>;

struct Watch {
    std::function<void(const std::string& what, size_t total)> begin; ///< starts a part of `total` pieces
    std::function<void()> advance;                                    ///< one piece is done
    KeepGoing keep_going; ///< false: stop, and return the results so far
};

// Measures the wall-clock and CPU time of a piece of work.

/// Milliseconds of wall-clock time, and of CPU time of all threads of this process.
struct Elapsed {
    double wall = 0;
    double cpu = 0;
};

/// A clock that starts at construction.
class Stopwatch {
public:
    Stopwatch();
    Elapsed elapsed() const;

private:
    std::chrono::steady_clock::time_point wall_;
    double cpu_;
};

// Runs independent pieces of work on all cores.

/// Calls `work` with 0 to count - 1, in any order and concurrently. Calls `keep_going` on the calling thread
/// only, before each piece that this thread takes. Once it returns false, no more pieces start and the result
/// is false.
bool on_all_cores(size_t count, const KeepGoing& keep_going, const std::function<void(size_t)>& work);

// Chooses pixels to sample if not all can be.

/// Returns the i-th element of a permutation of 0 to count - 1 whose every prefix is evenly spread (steps of
/// the golden section).
size_t spread(size_t i, size_t count);

// Statistics of repeated measurements for reports. Pure and deterministic.

/// Returns the value below which the fraction `part` (0..1) of the values lies, with linear interpolation;
/// NaN if `values` is empty.
double quantile(std::vector<double> values, double part);
double quantile_of_sorted(std::span<const double> values, double part);
inline double median(std::vector<double> values) {
    return quantile(std::move(values), 0.5);
}

/// A 95 % confidence interval.
struct Interval {
    double low = 0;
    double high = 0;

    bool contains(double value) const { return low <= value && value <= high; }
    bool overlaps(const Interval& other) const { return low <= other.high && other.low <= high; }
};

/// Returns the percentile bootstrap interval of a statistic: the middle 95 % of its values over 1,000
/// resamples of `count` rows with replacement, with a fixed seed. `of` computes the statistic of the rows
/// drawn. NaN if `count` is below k_fewest_runs.
Interval bootstrap(size_t count, const std::function<double(const std::vector<size_t>& rows)>& of);
Interval bootstrap_median(const std::vector<double>& values);

/// Returns the one-sided 95 % upper bound of a proportion (0..1) estimated from a sample (E. B. Wilson:
/// Probable inference, JASA 22, 1927).
double most_of_share(size_t some, size_t sampled);

/// Fewest values for an interval. With fewer it is NaN, and contains and overlaps nothing.
inline constexpr size_t k_fewest_runs = 5;

/// Summary of run times, milliseconds.
struct TimeSummary {
    size_t runs = 0;
    double median = 0;
    double smallest = 0;
    Interval confidence{}; ///< 95 % interval of the median
    double first_quartile = 0;
    double third_quartile = 0;
    /// Median of the last third of the runs over that of the first; 1 with fewer than 15 runs. It differs
    /// from 1 on a machine that warms up or gets other load.
    double drift = 1;
    bool drifted = false; ///< the intervals of both medians do not overlap
};

/// Summarises run times, which must be in the order of measurement.
TimeSummary summary_of(const std::vector<double>& values);

/// Returns 0 to count - 1 shuffled; the same for the same seed on every machine.
std::vector<size_t> shuffled(size_t count, unsigned seed);

} // namespace tidemark::lab
