#include "lab/study_data.hpp"

#include "base/error.hpp"
#include "lab/study.hpp"
#include "lab/work_precision.hpp"
#include "scene/json_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace tidemark::lab {
namespace {

using scene::Json;

Json json_number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

// ---- The numbers of an outcome, for both JSON and CSV ----------------------------------------------------

struct DataColumn {
    const char* group; ///< in JSON
    const char* name;
    std::function<double(const Outcome&)> of; ///< NaN: not measured
};

double missing() {
    return std::nan("");
}

DataColumn hit(const char* name, double HitErrors::*field) {
    return {"hits", name, [field](const Outcome& o) { return o.hits ? (*o.hits).*field : missing(); }};
}

DataColumn picture(const char* name, std::function<double(const image::PictureMetrics&)> of) {
    return {"picture", name, [of = std::move(of)](const Outcome& o) { return of(o.picture); }};
}

DataColumn time(const char* group, const char* name, TimeSummary Outcome::*clock,
                std::function<double(const TimeSummary&)> of) {
    return {group, name, [clock, of = std::move(of)](const Outcome& o) {
                return (o.*clock).runs > 0 ? of(o.*clock) : missing();
            }};
}

const std::vector<DataColumn>& columns() {
    using Metrics = image::PictureMetrics;
    static const std::vector<DataColumn> k_all_columns = [] {
        std::vector<DataColumn> list{
            hit("rms_t", &HitErrors::rms),
            hit("rms_right_t", &HitErrors::rms_right),
            hit("median_t", &HitErrors::median),
            hit("p95_t", &HitErrors::p95),
            hit("p99_t", &HitErrors::p99),
            hit("largest_t", &HitErrors::largest),
            hit("false_miss_percent", &HitErrors::false_miss),
            hit("false_hit_percent", &HitErrors::false_hit),
            hit("wrong_0.01_percent", &HitErrors::wrong_hundredth),
            hit("wrong_0.1_percent", &HitErrors::wrong_tenth),
            hit("wrong_0.1_percent_at_most", &HitErrors::most_wrong_tenth),
            hit("wrong_footprint_percent", &HitErrors::wrong_footprint),
            hit("exhausted_percent", &HitErrors::exhausted),
            hit("negative_sample_percent", &HitErrors::negative),
            hit("no_answer_percent", &HitErrors::no_answer),
            hit("evaluations_per_pixel", &HitErrors::evaluations),
            {"hits", "no_truth_pixels",
             [](const Outcome& o) { return o.hits ? double(o.hits->no_truth) : missing(); }},
            picture("rmse", [](const Metrics& m) { return m.samples.rmse; }),
            picture("psnr_db", [](const Metrics& m) { return m.samples.psnr; }),
            picture("relative_mse", [](const Metrics& m) { return m.samples.relative_mse; }),
            picture("largest", [](const Metrics& m) { return m.samples.largest; }),
            picture("ssim", [](const Metrics& m) { return m.ssim; }),
            picture("flip", [](const Metrics& m) { return m.flip; }),
            picture("non_finite_pixels",
                    [](const Metrics& m) {
                        return double(m.samples.one_non_finite + m.samples.both_non_finite);
                    }),
            {"picture", "no_truth_pixels", [](const Outcome& o) { return double(o.no_truth); }},
        };
        for (const auto& [group, clock] :
             {std::pair{"wall_ms", &Outcome::wall}, {"cpu_ms", &Outcome::cpu}, {"gpu_ms", &Outcome::gpu}}) {
            list.push_back(time(group, "median", clock, [](const TimeSummary& t) { return t.median; }));
            list.push_back(
                time(group, "ci95_low", clock, [](const TimeSummary& t) { return t.confidence.low; }));
            list.push_back(
                time(group, "ci95_high", clock, [](const TimeSummary& t) { return t.confidence.high; }));
            list.push_back(time(group, "smallest", clock, [](const TimeSummary& t) { return t.smallest; }));
            list.push_back(time(group, "p25", clock, [](const TimeSummary& t) { return t.first_quartile; }));
            list.push_back(time(group, "p75", clock, [](const TimeSummary& t) { return t.third_quartile; }));
            list.push_back(time(group, "runs", clock, [](const TimeSummary& t) { return double(t.runs); }));
            list.push_back(time(group, "drift", clock, [](const TimeSummary& t) { return t.drift; }));
        }
        return list;
    }();
    return k_all_columns;
}

// ---- JSON -----------------------------------------------------------------------------------------------

Json settings_json(const std::vector<Setting>& settings) {
    Json json = Json::object();
    for (const Setting& setting : settings)
        json[setting.name] = setting.value;
    return json;
}

bool measured(const WorkPrecisionSet& set, const Outcome& outcome, std::string_view group) {
    return group == "hits"      ? set.has_hits()
           : group == "picture" ? set.has_pictures()
           : group == "gpu_ms"  ? outcome.gpu.runs > 0
                                : true;
}

Json outcome_json(const WorkPrecisionSet& set, const Outcome& outcome) {
    Json json;
    for (const DataColumn& column : columns())
        if (measured(set, outcome, column.group))
            json[column.group][column.name] = json_number(column.of(outcome));
    if (outcome.wall.runs > 0)
        json["wall_ms"]["drifted"] = outcome.wall.drifted;
    if (outcome.hits)
        for (size_t i = 1; i < k_causes; ++i)
            json["causes"][std::string(to_string(Cause(i)))] = outcome.causes[i];
    return json;
}

Json standard_json(const Standard& standard) {
    const bool known = standard.uncertainty && standard.none.empty(); // a missing truth has no error
    Json json = {{"method", standard.method},
                 {"uncertainty", known ? json_number(*standard.uncertainty) : Json(nullptr)},
                 {"self_check", standard.check},
                 {"no_truth_pixels", standard.blind}};
    if (!standard.none.empty())
        json["none"] = standard.none;
    return json;
}

Json idle_json(const std::vector<IdleKnob>& idle) {
    Json json = Json::array();
    for (const IdleKnob& knob : idle)
        json.push_back({{"knob", knob.name}, {"series", knob.series}});
    return json;
}

Json orders_json(const std::vector<ObservedOrder>& orders) {
    Json json = Json::array();
    for (const ObservedOrder& order : orders) {
        json.push_back({{"series", order.series},
                        {"knob", order.knob},
                        {"fixed", settings_json(order.fixed)},
                        {"order", order.order ? json_number(*order.order) : Json(nullptr)},
                        {"fit", order.how}});
        if (order.order)
            json.back()["uncertainty"] = json_number(order.uncertainty);
    }
    return json;
}

Trust trust_of(const WorkPrecisionSet& set, const Point& point) {
    return point.series < set.study.series.size() ? set.study.series[point.series].trust : Trust::unknown;
}

Json point_json(const WorkPrecisionSet& set, const WorkPrecision& point) {
    Json json = {{"label", point.point.label},
                 {"series", series_name(set, point.point)},
                 {"trust", to_string(trust_of(set, point.point))},
                 {"settings", settings_json(point.point.settings)}};
    if (!point.measured()) {
        json["failure"] = point.failure;
        return json;
    }
    json["hollow"] = point.hollow;
    json["idle"] = point.idle;
    json["on_front"] = point.on_front;
    json["compile_ms"] = json_number(point.compile_milliseconds);
    json["first_draw_ms"] = json_number(point.first_draw_milliseconds);
    json["all"] = outcome_json(set, point.all);
    json["views"] = Json::object();
    for (size_t i = 0; i < point.views.size(); ++i)
        json["views"][set.study.views[i].name] = outcome_json(set, point.views[i]);
    json["shares"] = Json::array();
    for (const Share& share : point.shares)
        json["shares"].push_back(
            {{"source", share.source}, {"rms_t", json_number(share.rms)}, {"rmse", json_number(share.rmse)}});
    return json;
}

Json views_json(const Study& study) {
    Json views = Json::array();
    for (const View& view : study.views) {
        views.push_back(
            {{"name", view.name}, {"time", view.state.seconds()}, {"mouse", {view.mouse.x, view.mouse.y}}});
        if (const auto& camera = view.state.camera; camera != render::OrbitCamera{})
            views.back()["camera"] = {camera.azimuth, camera.elevation, camera.distance};
    }
    return views;
}

// ---- CSV ------------------------------------------------------------------------------------------------

/// Quotes a field for spreadsheets: on one line, and never taken for a formula.
std::string csv_text(std::string_view text) {
    constexpr std::string_view k_begin_formulas = "=+-@";
    std::string quoted = "\"";
    const bool formula = !text.empty() && k_begin_formulas.find(text.front()) != k_begin_formulas.npos;
    if (formula && !number_of(std::string(text)))
        quoted += "'";
    for (const char c : one_line(text))
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + '"';
}

/// Returns a name that no other column has.
std::string free_name(std::string name, const std::vector<std::string>& taken) {
    while (std::ranges::find(taken, name) != taken.end())
        name.insert(0, "set ");
    return name;
}

/// Returns all column heads: those of a point, the knobs that points set, the numbers of an outcome.
std::vector<std::string> csv_heads(const std::vector<std::string>& knobs) {
    std::vector<std::string> first{"series", "trust",    "label",      "view",         "hollow",
                                   "idle",   "on_front", "compile_ms", "first_draw_ms"};
    std::vector<std::string> last;
    for (const DataColumn& column : columns()) {
        const std::string name = std::string(column.group) + "_" + column.name;
        const bool timed = std::string_view(column.group).ends_with("_ms");
        const bool known = std::ranges::find(last, column.name) != last.end();
        last.push_back(timed || known ? name : column.name);
    }
    std::vector<std::string> taken = first;
    taken.insert(taken.end(), last.begin(), last.end());
    for (const std::string& knob : knobs) {
        first.push_back(free_name(knob, taken));
        taken.push_back(first.back());
    }
    first.insert(first.end(), last.begin(), last.end());
    return first;
}

} // namespace

std::string to_json(const WorkPrecisionSet& set) {
    const Circumstances& facts = set.circumstances;
    Json json = {
        {"schema", k_study_schema},
        {"complete", facts.complete},
        {"tidemark", facts.tidemark},
        {"scene", {{"file", facts.scene}, {"sha256", facts.scene_sha256}}},
        {"about", set.study.about},
        {"size", set.has_pictures() ? Json{set.study.extent.width, set.study.extent.height} : Json(nullptr)},
        {"precision", set.study.precision == glsl::Precision::single ? "single" : "double"},
        {"views", views_json(set.study)},
        {"error", error_name(set)},
        {"promise",
         {{"wrong_percent", set.study.promise.most_wrong_percent}, {"psnr", set.study.promise.least_psnr}}},
        {"references", Json::object()},
        {"machine",
         {{"renderer", facts.renderer},
          {"driver", facts.driver},
          {"cores", facts.cores},
          {"load_before", facts.load_before},
          {"load_after", facts.load_after}}},
        {"timing",
         {{"started", facts.started},
          {"clock", facts.clock},
          {"warm_up_rounds", facts.warm_up_rounds},
          {"timed_rounds", facts.timed_rounds}}},
        {"verdict", sentences(set)},
        {"idle", idle_json(set.idle)},
        {"orders", orders_json(set.orders)},
        {"held", settings_json(set.held)},
        {"remarks", facts.remarks},
        {"points", Json::array()}};
    if (set.has_pictures())
        json["references"]["picture"] = standard_json(set.picture_standard);
    if (set.has_hits())
        json["references"]["hits"] = standard_json(set.hit_standard);
    for (const WorkPrecision& point : set.points)
        json["points"].push_back(point_json(set, point));
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_csv(const WorkPrecisionSet& set) {
    const std::vector<std::string> knobs = set_names(set);
    std::string text;
    for (const std::string& head : csv_heads(knobs))
        text += (text.empty() ? "" : ",") +
                (std::ranges::find(knobs, head) == knobs.end() && head.find_first_of("\", ") == head.npos
                     ? head
                     : csv_text(head));
    text += '\n';
    for (const WorkPrecision& point : set.points) {
        if (!point.measured())
            continue;
        std::string values;
        for (const std::string& knob : knobs)
            values += "," + csv_text(value_at(set, point.point, knob));
        for (size_t view = 0; view <= point.views.size(); ++view) {
            const bool all = view == point.views.size();
            text += fmt::format(
                "{},{},{},{},{},{},{},{:.6g},{:.6g}{}", csv_text(series_name(set, point.point)),
                to_string(trust_of(set, point.point)), csv_text(point.point.label),
                csv_text(all ? "all" : set.study.views[view].name), int(point.hollow), int(point.idle),
                int(point.on_front), point.compile_milliseconds, point.first_draw_milliseconds, values);
            for (const DataColumn& column : columns()) {
                const Outcome& outcome = all ? point.all : point.views[view];
                const double value = measured(set, outcome, column.group) ? column.of(outcome) : missing();
                text += std::isnan(value) ? "," : fmt::format(",{:.9g}", value);
            }
            text += '\n';
        }
    }
    return text;
}

namespace {

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
        found.worse.push_back(fmt::format("{}: less exact: {} {} -> {}", now.point.label, error_name(set),
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
            fmt::format("not a study of schema \"{}\"; give the study.json of a report", k_study_schema));
    if (!same_views(old, set.study))
        return refuse("that study has other views or another size");
    Comparison found;
    const Json::json_pointer renderer("/machine/renderer");
    const bool same_machine = old.contains(renderer) && old[renderer] == set.circumstances.renderer &&
                              number_at(old, "/machine/cores") == set.circumstances.cores;
    if (!same_machine)
        found.notes.emplace_back("times are not compared: the baseline is from another machine");
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
        found.notes.push_back("errors are not compared: there is no reference now: " + none);
    if (found.compared == 0)
        found.notes.emplace_back("the two studies have no setting in common");
    return found;
}

} // namespace tidemark::lab
