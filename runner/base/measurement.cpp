#include "base/measurement.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <random>
#include <system_error>
#include <thread>
#include <vector>

namespace tidemark::lab {
namespace {

double cpu_milliseconds() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto milliseconds = [](const timeval& t) {
        return double(t.tv_sec) * 1e3 + double(t.tv_usec) * 1e-3;
    };
    return milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime);
}

} // namespace

Stopwatch::Stopwatch() : wall_(std::chrono::steady_clock::now()), cpu_(cpu_milliseconds()) {}

Elapsed Stopwatch::elapsed() const {
    const auto wall = std::chrono::steady_clock::now() - wall_;
    return {std::chrono::duration<double, std::milli>(wall).count(), cpu_milliseconds() - cpu_};
}

bool on_all_cores(size_t count, const KeepGoing& keep_going, const std::function<void(size_t)>& work) {
    std::atomic<size_t> next{0};
    std::atomic<bool> going{true};
    const auto run = [&](const KeepGoing& ask) {
        for (size_t i = next++; i < count && going; i = next++) {
            if (ask())
                work(i);
            else
                going = false;
        }
    };
    std::vector<std::jthread> helpers;
    try {
        for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i)
            helpers.emplace_back(run, [] { return true; });
    } catch (const std::system_error&) { // thread limit reached: go on with fewer threads
    }
    run(keep_going);
    helpers.clear(); // joins the threads
    return going;
}

size_t spread(size_t i, size_t count) {
    constexpr double k_golden_section = 0.6180339887498949;
    auto step = size_t(double(count) * k_golden_section) + 1;
    while (std::gcd(step, count) != 1)
        ++step;
    return i * step % count;
}

namespace {

constexpr int k_resamples = 1000;

/// Returns a random number below `count`. std::uniform_int_distribution differs between standard libraries.
size_t below(std::mt19937& random, size_t count) {
    return size_t((uint64_t(random()) * count) >> 32);
}

} // namespace

double quantile_of_sorted(std::span<const double> values, double part) {
    if (values.empty())
        return std::nan("");
    const double place = part * double(values.size() - 1);
    const auto low = size_t(place);
    const size_t high = std::min(low + 1, values.size() - 1);
    return values[low] + (place - double(low)) * (values[high] - values[low]);
}

double most_of_share(size_t some, size_t sampled) {
    if (sampled == 0)
        return 1;
    constexpr double k_z = 1.6448536269514722; // 95 % of a normal distribution lies below
    const double n = double(sampled), part = double(some) / n, z2 = k_z * k_z;
    return (part + z2 / (2 * n) + k_z * std::sqrt(part * (1 - part) / n + z2 / (4 * n * n))) / (1 + z2 / n);
}

double quantile(std::vector<double> values, double part) {
    std::sort(values.begin(), values.end());
    return quantile_of_sorted(values, part);
}

Interval bootstrap(size_t count, const std::function<double(const std::vector<size_t>& rows)>& of) {
    if (count < k_fewest_runs)
        return {std::nan(""), std::nan("")};
    std::mt19937 random(20240607);
    std::vector<double> found;
    std::vector<size_t> rows(count);
    for (int i = 0; i < k_resamples; ++i) {
        std::ranges::generate(rows, [&] { return below(random, count); });
        found.push_back(of(rows));
    }
    std::sort(found.begin(), found.end());
    return {quantile_of_sorted(found, 0.025), quantile_of_sorted(found, 0.975)};
}

Interval bootstrap_median(const std::vector<double>& values) {
    std::vector<double> drawn;
    return bootstrap(values.size(), [&](const std::vector<size_t>& rows) {
        drawn.clear();
        for (const size_t row : rows)
            drawn.push_back(values[row]);
        return median(drawn);
    });
}

TimeSummary summary_of(const std::vector<double>& values) {
    TimeSummary summary;
    summary.runs = values.size();
    if (values.empty()) {
        summary.median = summary.smallest = summary.first_quartile = summary.third_quartile = std::nan("");
        summary.confidence = {std::nan(""), std::nan("")};
        return summary;
    }
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    summary.median = quantile_of_sorted(sorted, 0.5);
    summary.smallest = sorted.front();
    summary.first_quartile = quantile_of_sorted(sorted, 0.25);
    summary.third_quartile = quantile_of_sorted(sorted, 0.75);
    summary.confidence = bootstrap_median(values);
    if (const size_t third = values.size() / 3; third >= k_fewest_runs) {
        const std::vector<double> first(values.begin(), values.begin() + ptrdiff_t(third));
        const std::vector<double> last(values.end() - ptrdiff_t(third), values.end());
        summary.drift = median(last) / median(first);
        summary.drifted = !bootstrap_median(first).overlaps(bootstrap_median(last));
    }
    return summary;
}

std::vector<size_t> shuffled(size_t count, unsigned seed) {
    std::vector<size_t> order(count);
    std::iota(order.begin(), order.end(), size_t{0});
    std::mt19937 random(seed);
    for (size_t i = count; i > 1; --i)
        std::swap(order[i - 1], order[below(random, i)]);
    return order;
}

} // namespace tidemark::lab
