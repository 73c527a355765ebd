#include "lab/study/work_precision.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

constexpr double k_solid = 10; ///< an error is worth showing from so many uncertainties of the reference up

bool timed(const WorkPrecision& point) {
    return point.measured() && point.all.time().runs > 0;
}

/// At least as good in both, better in one.
bool dominates(const WorkPrecisionSet& set, const WorkPrecision& a, const WorkPrecision& b) {
    const double error_a = error_of(set, a.all), error_b = error_of(set, b.all);
    const double time_a = a.all.time().median, time_b = b.all.time().median;
    return error_a <= error_b && time_a <= time_b && (error_a < error_b || time_a < time_b);
}

} // namespace

double error_of(const WorkPrecisionSet& set, const Outcome& outcome) {
    return set.has_hits() && outcome.hits ? outcome.hits->rms : outcome.picture.samples.rmse;
}

std::string error_name(const WorkPrecisionSet& set) {
    return set.has_hits() ? set.words.distance_error : "RMSE of the picture";
}

std::vector<double> mean_of_views(const std::vector<std::vector<double>>& clock) {
    std::vector<double> means(clock.empty() ? 0 : clock.front().size(), 0.0);
    for (const std::vector<double>& view : clock)
        for (size_t i = 0; i < means.size(); ++i)
            means[i] += view[i] / double(clock.size());
    return means;
}

void judge(WorkPrecisionSet& set) {
    const auto& uncertainty =
        set.has_hits() ? set.hit_standard.uncertainty : set.picture_standard.uncertainty;
    for (WorkPrecision& point : set.points) {
        const double error = error_of(set, point.all);
        point.hollow = point.measured() && (!uncertainty || !(error >= k_solid * *uncertainty));
        point.on_front = timed(point) && !std::isnan(error) &&
                         std::ranges::none_of(set.points, [&](const WorkPrecision& other) {
                             return timed(other) && dominates(set, other, point);
                         });
    }
}

} // namespace tidemark::lab
