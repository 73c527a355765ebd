#include "lab/study/study.hpp"

#include <algorithm>

namespace tidemark::lab {
namespace {

/// Returns all combinations, the last axis fastest.
std::vector<std::vector<Setting>> combinations(const std::vector<Axis>& axes) {
    std::vector<std::vector<Setting>> found{{}};
    for (const Axis& axis : axes) {
        std::vector<std::vector<Setting>> longer;
        for (const auto& start : found)
            for (const std::string& value : axis.values) {
                longer.push_back(start);
                longer.back().push_back({axis.name, value});
            }
        found = std::move(longer);
    }
    return found;
}

std::string values_of(const std::vector<Setting>& settings) {
    std::string text;
    for (const Setting& setting : settings)
        text += (text.empty() ? "" : ", ") + setting.value;
    return text;
}

} // namespace

std::string_view to_string(Trust trust) {
    switch (trust) {
    case Trust::certified: return "certified";
    case Trust::bound_assumed: return "bound assumed";
    case Trust::heuristic: return "heuristic";
    case Trust::unknown: break;
    }
    return "unknown";
}

std::vector<Point> points_of(const Study& study) {
    std::vector<Point> points{{study.series.size(), std::string(k_defaults), std::string(k_defaults), {}}};
    for (size_t i = 0; i < study.series.size(); ++i)
        for (const std::vector<Setting>& turned : combinations(study.series[i].axes)) {
            std::vector<Setting> all = study.series[i].settings;
            all.insert(all.end(), turned.begin(), turned.end());
            const bool known = std::ranges::find(points, all, &Point::settings) != points.end();
            if (!known)
                points.push_back({i, to_string(all), values_of(turned), std::move(all)});
        }
    return points;
}

std::vector<Series> series_of(const std::vector<Axis>& axes) {
    if (axes.empty())
        return {};
    std::vector<Series> series;
    for (std::vector<Setting>& fixed : combinations({axes.begin(), axes.end() - 1})) {
        std::string name = fixed.empty() ? axes.back().name : to_string(fixed);
        series.push_back({std::move(name), Trust::unknown, std::move(fixed), {axes.back()}});
    }
    return series;
}

} // namespace tidemark::lab
