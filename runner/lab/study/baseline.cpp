#include "lab/study/baseline.hpp"

#include "base/try.hpp"
#include "lab/study/report_data.hpp"
#include "lab/study/verdict.hpp"
#include "scene/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

using scene::Json;

constexpr double k_slower = 1.05;
constexpr double k_more_wrong = 1.01;

/// Returns NaN if the place does not hold a number.
double number_at(const Json& json, const std::string& pointer) {
    const Json::json_pointer place(pointer);
    return json.contains(place) && json[place].is_number() ? json[place].get<double>() : std::nan("");
}

void compare_errors(const WorkPrecisionSet& set, const Json& before, const WorkPrecision& now,
                    Comparison& found) {
    const double was = number_at(before, set.ranked_by_hits() ? "/all/hits/rms_t" : "/all/picture/rmse");
    const double is = error_of(set, now.all);
    const double noise = standard_of(set).uncertainty.value_or(0.0);
    if (std::isnan(was))
        found.notes.push_back(
            fmt::format("{}: its error is not compared: the baseline has no number for it", now.point.label));
    else if (!(is <= was * k_more_wrong) && !(is <= was + noise)) // a NaN error is worse
        found.worse.push_back(fmt::format("{}: more wrong: {} {} -> {}", now.point.label, error_name(set),
                                          figure(was), figure(is)));
}

void compare_times(const Json& before, const WorkPrecision& now, Comparison& found) {
    const double was = number_at(before, "/all/wall_ms/median"),
                 high = number_at(before, "/all/wall_ms/ci95_high");
    const TimeSummary& time = now.all.wall; // wall time in both, whichever clock the studies used
    if (time.median > was * k_slower && time.confidence.low > high)
        found.worse.push_back(fmt::format("{}: slower: {} ms -> {} ms [{}, {}]", now.point.label, figure(was),
                                          figure(time.median), figure(time.confidence.low),
                                          figure(time.confidence.high)));
}

bool same_view(const Json& old, const View& view) {
    const auto same = [&](const char* pointer, double value) { return number_at(old, pointer) == value; };
    const render::OrbitCamera& camera = view.state.camera;
    const bool same_camera = old.contains("camera")
                                 ? same("/camera/0", camera.azimuth) && same("/camera/1", camera.elevation) &&
                                       same("/camera/2", camera.distance)
                                 : camera == render::OrbitCamera{};
    return same("/time", view.state.seconds()) && same("/mouse/0", view.mouse.x) &&
           same("/mouse/1", view.mouse.y) && same_camera;
}

bool same_views(const Json& old, const Study& study) {
    const Json* views = old.contains("views") && old["views"].is_array() ? &old["views"] : nullptr;
    if (!views || views->size() != study.views.size())
        return false;
    for (size_t i = 0; i < study.views.size(); ++i)
        if (!same_view((*views)[i], study.views[i]))
            return false;
    return number_at(old, "/size/0") == study.extent.width &&
           number_at(old, "/size/1") == study.extent.height;
}

} // namespace

Result<Comparison> compare_with(std::string_view old_study, const std::string& file,
                                const WorkPrecisionSet& set) {
    auto old = TRY(scene::parse_json(old_study, file));
    const auto refuse = [&](std::string_view why) {
        return fail(ErrorCode::load, fmt::format("--baseline '{}': {}", file, why));
    };
    if (!old.is_object() || !old.contains("schema") || old["schema"] != k_study_schema ||
        !old["points"].is_array())
        return refuse(
            fmt::format("no study of schema \"{}\"; give the study.json of a report", k_study_schema));
    if (!same_views(old, set.study))
        return refuse("that study has other views or another size");
    Comparison found;
    const Json::json_pointer renderer("/machine/renderer");
    const bool same_machine = old.contains(renderer) && old[renderer] == set.circumstances.renderer &&
                              number_at(old, "/machine/cores") == set.circumstances.cores;
    if (!same_machine)
        found.notes.emplace_back("times are not compared: the baseline is of another machine");
    for (const WorkPrecision& point : set.points) {
        const Json& points = old["points"];
        const auto before = std::ranges::find_if(points, [&](const Json& json) {
            return json.is_object() && json.contains("all") && json.contains("label") &&
                   json["label"] == point.point.label;
        });
        if (before == points.end())
            continue;
        if (!point.measured()) {
            found.worse.push_back(fmt::format("{}: fails now: {}", point.point.label, point.failure));
            continue;
        }
        ++found.compared;
        if (standard_of(set).none.empty())
            compare_errors(set, *before, point, found);
        if (same_machine)
            compare_times(*before, point, found);
    }
    if (const std::string& none = standard_of(set).none; !none.empty())
        found.notes.push_back("errors are not compared: there is no truth now: " + none);
    if (found.compared == 0)
        found.notes.emplace_back("the two studies have no setting in common");
    return found;
}

} // namespace tidemark::lab
