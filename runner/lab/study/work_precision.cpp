#include "lab/study/work_precision.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

constexpr double k_solid = 10; ///< an error is reliable from this many uncertainties of the reference on

/// Returns whether `a` is at least as good as `b` in both error and time, and better in one.
bool dominates(const WorkPrecisionSet& set, const WorkPrecision& a, const WorkPrecision& b) {
    const double error_a = error_of(set, a.all), error_b = error_of(set, b.all);
    const double time_a = a.all.time().median, time_b = b.all.time().median;
    return error_a <= error_b && time_a <= time_b && (error_a < error_b || time_a < time_b);
}

} // namespace

double error_of(const WorkPrecisionSet& set, const Outcome& outcome) {
    return set.ranked_by_hits() && outcome.hits ? outcome.hits->rms : outcome.picture.samples.rmse;
}

std::string error_name(const WorkPrecisionSet& set) {
    return set.ranked_by_hits() ? set.words.distance_error : "RMSE of the picture";
}

const Standard& standard_of(const WorkPrecisionSet& set) {
    return set.ranked_by_hits() ? set.hit_standard : set.picture_standard;
}

std::vector<std::string> set_names(const WorkPrecisionSet& set) {
    std::vector<std::string> names;
    for (const WorkPrecision& point : set.points)
        for (const Setting& setting : point.point.settings)
            if (std::ranges::find(names, setting.name) == names.end())
                names.push_back(setting.name);
    return names;
}

std::string value_at(const WorkPrecisionSet& set, const Point& point, const std::string& name) {
    for (const std::vector<Setting>& settings : {merged(point.settings), set.scene_values})
        if (const auto found = std::ranges::find(settings, name, &Setting::name); found != settings.end())
            return found->value;
    return {};
}

std::string series_name(const WorkPrecisionSet& set, const Point& point) {
    return point.series < set.study.series.size() ? set.study.series[point.series].name
                                                  : std::string(k_defaults);
}

std::vector<double> mean_of_views(const std::vector<std::vector<double>>& clock) {
    std::vector<double> means(clock.empty() ? 0 : clock.front().size(), 0.0);
    for (const std::vector<double>& view : clock)
        for (size_t i = 0; i < means.size(); ++i)
            means[i] += view[i] / double(clock.size());
    return means;
}

void judge(WorkPrecisionSet& set) {
    const auto& uncertainty = standard_of(set).uncertainty;
    for (WorkPrecision& point : set.points) {
        const double error = error_of(set, point.all);
        point.hollow = point.measured() && (!uncertainty || !(error >= k_solid * *uncertainty));
        point.on_front = point.timed() && !point.idle && !std::isnan(error) &&
                         std::ranges::none_of(set.points, [&](const WorkPrecision& other) {
                             return other.timed() && !other.idle && dominates(set, other, point);
                         });
    }
}

} // namespace tidemark::lab
