#include "lab/study.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "scene/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tidemark::lab {
namespace {

constexpr double k_last_time = 1e9; ///< about 30 years, far beyond a float's precision

bool take(std::string_view& text, double& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    text.remove_prefix(size_t(end - text.data()));
    return error == std::errc{};
}

bool take(std::string_view& text, char wanted) {
    if (!text.starts_with(wanted))
        return false;
    text.remove_prefix(1);
    return true;
}

} // namespace

render::FrameState state_of(const View& view, Extent extent) {
    render::FrameState state = view.state;
    state.extent = extent;
    if (view.mouse != glm::dvec2(0)) // a click that has ended
        state.mouse = render::Mouse::clicked(view.mouse * glm::dvec2(extent.width, extent.height), false);
    return state;
}

Result<void> check(const View& view) {
    const double time = view.state.seconds();
    if (!(time >= 0 && time <= k_last_time))
        return fail(ErrorCode::usage,
                    fmt::format("view '{}': the time {} is out of range; give 0 to {:g} seconds", view.name,
                                time, k_last_time));
    for (const double part : {view.mouse.x, view.mouse.y})
        if (!(part >= 0 && part <= 1))
            return fail(ErrorCode::usage,
                        fmt::format("view '{}': the mouse at {}, {} is outside the picture; give fractions "
                                    "of its width and height, 0 to 1",
                                    view.name, view.mouse.x, view.mouse.y));
    return {};
}

Result<std::vector<View>> parse_views(std::string_view text) {
    std::vector<View> views;
    std::string_view rest = text;
    do {
        const std::string_view begin = rest;
        View view;
        double time = 0;
        bool good = take(rest, time);
        view.state = render::at_time(time);
        if (good && take(rest, '@'))
            good = take(rest, view.mouse.x) && take(rest, ',') && take(rest, view.mouse.y);
        view.name = fmt::format("t={}", begin.substr(0, begin.size() - rest.size()));
        if (!good || (!rest.empty() && rest.front() != ';'))
            return fail(
                ErrorCode::usage,
                fmt::format("--views {}: give times and places of the mouse, as in 0;10@0.75,0.4, or a "
                            ".json file",
                            text));
        TRY(check(view));
        if (std::ranges::find(views, view.name, &View::name) != views.end())
            return fail(ErrorCode::usage, fmt::format("--views {}: '{}' is given twice", text, view.name));
        views.push_back(std::move(view));
    } while (take(rest, ';'));
    return views;
}

View unseen(const View& view, double seconds_later) {
    View later = view;
    const double fps = view.state.fps;
    const double seconds = view.state.seconds() + std::round(seconds_later * fps) / fps;
    later.state = render::at_time(seconds, view.state);
    later.name = fmt::format("t={:g}, not searched", seconds);
    return later;
}

Extent small_of(Extent extent, int longest) {
    const int longer = std::max(extent.width, extent.height);
    const auto side = [&](int length) { return std::max(1, length * longest / longer); };
    return longer <= longest ? extent : Extent{side(extent.width), side(extent.height)};
}

Extent affordable(Extent requested, double needed, double left, int least) {
    const int longer = std::max(requested.width, requested.height);
    const double scale = std::min(1.0, std::sqrt(std::max(0.0, left) / needed));
    return small_of(requested, std::max(int(longer * scale), std::min(least, longer)));
}

std::string smaller_verdict(Extent judged, Extent requested) {
    return fmt::format("the verdict is for {}x{} pixels: {}x{} need a longer --budget", judged.width,
                       judged.height, requested.width, requested.height);
}

std::vector<View> default_views() {
    return {{"t=1", render::at_time(1)}, {"t=10", render::at_time(10)}};
}

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

std::optional<double> number_of(const std::string& text) {
    const auto number = number_from<double>(text);
    return number && std::isfinite(*number) ? number : std::nullopt;
}

bool is_int(const std::string& number) {
    return number.find_first_of(".eE") == std::string::npos;
}

namespace {

std::string float_text(double number) {
    return float_literal(fmt::format("{:.9g}", number));
}

constexpr double k_largest_int = 1 << 30;

} // namespace

std::optional<std::string> scaled(const std::string& text, double factor) {
    const auto number = number_of(text);
    if (!number)
        return std::nullopt;
    const double value = *number * factor;
    if (!is_int(text))
        return float_text(value);
    if (std::abs(value) < 1 || std::abs(value) > k_largest_int)
        return std::nullopt;
    return fmt::format("{}", std::llround(value));
}

namespace {

/// Returns the ratio of the last two values of the axis; nullopt for texts, a single value, or a change of
/// sign.
std::optional<double> ratio_of(const Axis& axis) {
    if (axis.values.size() < 2)
        return std::nullopt;
    const auto last = number_of(axis.values.back()), before = number_of(axis.values[axis.values.size() - 2]);
    if (!last || !before || *last * *before <= 0 || *last == *before)
        return std::nullopt;
    return *last / *before;
}

} // namespace

std::optional<std::string> beyond(const Axis& axis, int steps) {
    if (axis.values.empty())
        return std::nullopt;
    if (steps <= 0)
        return size_t(-steps) < axis.values.size() ? std::optional(axis.values.end()[steps - 1])
                                                   : std::nullopt;
    const auto ratio = ratio_of(axis);
    if (!ratio)
        return std::nullopt;
    constexpr double k_most = 4; // of a count: larger steps soon exceed the iterations that a device can do
    const double most = is_int(axis.values.back()) ? k_most : INFINITY;
    return scaled(axis.values.back(),
                  std::pow(*ratio > 1 ? std::clamp(*ratio, 2.0, most) : std::min(*ratio, 0.5), steps));
}

std::vector<Axis> axes_of(const Study& study) {
    if (!study.axes.empty() || study.series.empty())
        return study.axes;
    std::vector<Axis> axes;
    for (const Setting& fixed : study.series.back().settings) {
        Axis axis{fixed.name, {}};
        for (const Series& series : study.series)
            for (const Setting& setting : series.settings)
                if (setting.name == fixed.name &&
                    std::ranges::find(axis.values, setting.value) == axis.values.end())
                    axis.values.push_back(setting.value);
        axes.push_back(std::move(axis));
    }
    const auto& own = study.series.back().axes;
    axes.insert(axes.end(), own.begin(), own.end());
    return axes;
}

namespace {

/// Returns the ratio of an axis that varies this knob; nullopt if there is none.
std::optional<double> ratio_of(const Study& study, std::string_view name) {
    std::vector<Axis> axes = axes_of(study);
    for (const Series& series : study.series)
        axes.insert(axes.end(), series.axes.begin(), series.axes.end());
    for (const Axis& axis : axes)
        if (const auto ratio = ratio_of(axis); ratio && axis.name == name)
            return ratio;
    return std::nullopt;
}

} // namespace

std::vector<Setting> strictest(const Study& study, int steps) {
    std::vector<Setting> settings;
    if (study.reference.empty()) {
        for (const Axis& axis : axes_of(study))
            for (int i = std::abs(steps); i >= 0; --i)
                if (auto value = beyond(axis, steps < 0 ? -i : i)) {
                    settings.push_back({axis.name, *std::move(value)});
                    break;
                }
        return settings;
    }
    for (const Setting& named : study.reference) {
        settings.push_back(named);
        if (const auto ratio = ratio_of(study, named.name); ratio && steps != 0) // by factors of two
            settings.back().value =
                scaled(named.value, std::pow(*ratio > 1 ? 2.0 : 0.5, steps)).value_or(named.value);
    }
    return settings;
}

std::vector<Setting> beside(const Study& study, int steps, bool second) {
    std::vector<Setting> settings = strictest(study, steps);
    for (Setting& setting : settings) {
        const auto ratio = ratio_of(study, setting.name);
        const double factor = second && !is_int(setting.value) ? 1.71 : 1.37;
        auto value = ratio ? scaled(setting.value, *ratio > 1 ? factor : 1 / factor) : std::nullopt;
        if (!value)
            continue;
        if (is_int(*value)) {
            const long long was = std::stoll(setting.value), is = std::stoll(*value);
            const long long one = *ratio > 1 ? 1 : -1;
            const bool even = std::ranges::find(study.even, setting.name) != study.even.end();
            const long long changed = ((was - is) % 2 != 0) != even ? is : is + one;
            const long long further = even ? 2 * one : one;
            value = fmt::format("{}", std::max(changed + (second ? further : 0), even ? 2LL : 1LL));
        }
        setting.value = *std::move(value);
    }
    return settings;
}

std::vector<std::string> knobs_with_even_values(const Study& study) {
    std::vector<std::string> names;
    for (const Axis& axis : axes_of(study)) {
        const auto is_even = [](const std::string& text) {
            return is_int(text) && number_of(text) && std::fmod(*number_of(text), 2) == 0;
        };
        if (axis.values.size() > 1 && std::ranges::all_of(axis.values, is_even))
            names.push_back(axis.name);
    }
    return names;
}

namespace {

using scene::Json;

/// Reads a JSON tree from the top, and keeps the first error with its place.
class Reader {
public:
    Reader(const std::string& file, std::string_view text) : file_(file), text_(text) {}

    Result<Study> read(const Json& json) {
        Study study;
        known(json, "",
              {"about", "size", "views", "series", "reference", "even", "sources", "model", "omissions",
               "promise"});
        if (json.contains("about"))
            study.about = string_of(json["about"], "/about");
        if (json.contains("size"))
            study.extent = extent_of(json["size"], "/size");
        each(json, "views", "",
             [&](const Json& item, const std::string& at) { add(study.views, view(item, at), at); });
        each(json, "series", "",
             [&](const Json& item, const std::string& at) { study.series.push_back(series(item, at)); });
        study.reference = settings(json, "reference", "");
        study.model = settings(json, "model", "");
        each(json, "sources", "", [&](const Json& item, const std::string& at) {
            known(item, at, {"name", "set", "precision"});
            study.sources.push_back(
                {required(item, "name", at), settings(item, "set", at), doubles(item, at)});
        });
        each(json, "omissions", "", [&](const Json& item, const std::string& at) {
            study.omissions.push_back(string_of(item, at));
        });
        each(json, "even", "",
             [&](const Json& item, const std::string& at) { study.even.push_back(string_of(item, at)); });
        if (json.contains("promise"))
            study.promise = promise(json["promise"]);
        if (error_)
            return fail(*error_);
        return study;
    }

private:
    void wrong(const std::string& pointer, std::string_view what) {
        if (!error_)
            error_ = error_at({file_, line_of(pointer), 0}, fmt::format("{}: {}", pointer, what));
    }

    /// Returns the line of the pointer's last name, found by searching the text for its names in order.
    int line_of(const std::string& pointer) const {
        size_t at = 0;
        for (size_t begin = 1; begin < pointer.size();) {
            const size_t end = std::min(pointer.find('/', begin), pointer.size());
            const std::string name = '"' + pointer.substr(begin, end - begin) + '"';
            if (const size_t found = text_.find(name, at); found != text_.npos)
                at = found;
            begin = end + 1;
        }
        return 1 + int(std::count(text_.begin(), text_.begin() + ptrdiff_t(at), '\n'));
    }

    /// Unknown names are errors: a study that silently ignores part of its file is misleading.
    void known(const Json& json, const std::string& at, const std::vector<std::string>& names) {
        if (!json.is_object())
            return wrong(at, "must be an object");
        for (const auto& [name, value] : json.items())
            if (std::ranges::find(names, name) == names.end()) {
                const std::string nearest = nearest_name(name, names);
                wrong(fmt::format("{}/{}", at, name), nearest.empty()
                                                          ? "is not known to a study"
                                                          : fmt::format("did you mean \"{}\"?", nearest));
            }
    }

    template <class Function>
    void each(const Json& json, const char* name, const std::string& at, Function function) {
        if (!json.is_object() || !json.contains(name))
            return;
        const std::string pointer = at + "/" + name;
        if (!json[name].is_array())
            return wrong(pointer, "must be an array");
        for (size_t i = 0; i < json[name].size(); ++i)
            function(json[name][i], fmt::format("{}/{}", pointer, i));
    }

    std::string string_of(const Json& json, const std::string& at) {
        if (json.is_string())
            return json.get<std::string>();
        wrong(at, "must be a string");
        return {};
    }

    double number_of(const Json& json, const std::string& at) {
        if (json.is_number())
            return json.get<double>();
        wrong(at, "must be a number");
        return 0;
    }

    std::string required(const Json& json, const char* name, const std::string& at) {
        if (json.is_object() && json.contains(name))
            return string_of(json[name], at + "/" + name);
        wrong(at, fmt::format("needs a \"{}\"", name));
        return {};
    }

    /// Returns a number in GLSL's notation, or a text unchanged.
    std::string value_of(const Json& json, const std::string& at) {
        if (json.is_string())
            return json.get<std::string>();
        if (json.is_number() || json.is_boolean())
            return json.dump();
        wrong(at, "must be a number or a string");
        return {};
    }

    std::vector<Setting> settings(const Json& json, const char* name, const std::string& at) {
        std::vector<Setting> found;
        if (!json.is_object() || !json.contains(name))
            return found;
        const std::string pointer = at + "/" + name;
        if (!json[name].is_object())
            wrong(pointer, "must be an object of knobs and values");
        else
            for (const auto& [knob, value] : json[name].items())
                found.push_back({knob, value_of(value, fmt::format("{}/{}", pointer, knob))});
        return found;
    }

    std::vector<Axis> axes(const Json& json, const std::string& at) {
        std::vector<Axis> found;
        if (!json.is_object() || !json.contains("vary"))
            return found;
        if (!json["vary"].is_object())
            wrong(at + "/vary", "must be an object of knobs and arrays of values");
        else
            for (const auto& [knob, values] : json["vary"].items()) {
                Axis axis{knob, {}};
                const std::string pointer = fmt::format("{}/vary/{}", at, knob);
                if (!values.is_array() || values.empty())
                    wrong(pointer, "must be an array of values, from the coarsest to the strictest");
                else
                    for (size_t i = 0; i < values.size(); ++i)
                        axis.values.push_back(value_of(values[i], fmt::format("{}/{}", pointer, i)));
                found.push_back(std::move(axis));
            }
        return found;
    }

    Extent extent_of(const Json& json, const std::string& at) {
        if (json.is_array() && json.size() == 2 && json[0].is_number_integer() &&
            json[1].is_number_integer() && json[0] >= 1 && json[1] >= 1 && json[0] <= 16384 &&
            json[1] <= 16384)
            return {json[0].get<int>(), json[1].get<int>()};
        wrong(at, "must be [width, height] in pixels");
        return {};
    }

    View view(const Json& json, const std::string& at) {
        known(json, at, {"name", "time", "mouse", "camera"});
        View found;
        found.name = required(json, "name", at);
        if (json.is_object() && json.contains("time"))
            found.state = render::at_time(number_of(json["time"], at + "/time"));
        if (json.is_object() && json.contains("mouse")) {
            const Json& mouse = json["mouse"];
            if (mouse.is_array() && mouse.size() == 2 && mouse[0].is_number() && mouse[1].is_number())
                found.mouse = {mouse[0].get<double>(), mouse[1].get<double>()};
            else
                wrong(at + "/mouse", "must be [x, y] in fractions of the picture");
        }
        if (json.is_object() && json.contains("camera")) {
            const auto camera = render::parse_camera(string_of(json["camera"], at + "/camera"));
            if (camera)
                found.state.camera = *camera;
            else
                wrong(at + "/camera", camera.error().message);
        }
        if (const auto checked = check(found); !checked)
            wrong(at, checked.error().message);
        return found;
    }

    /// View names must be unique, because a report refers to views by name.
    void add(std::vector<View>& views, View fresh, const std::string& at) {
        if (std::ranges::find(views, fresh.name, &View::name) != views.end())
            wrong(at + "/name", fmt::format("another view is named '{}' already", fresh.name));
        views.push_back(std::move(fresh));
    }

    Series series(const Json& json, const std::string& at) {
        known(json, at, {"name", "trust", "set", "vary"});
        Series found;
        found.name = required(json, "name", at);
        if (json.is_object() && json.contains("trust")) {
            const std::string trust = string_of(json["trust"], at + "/trust");
            constexpr Trust k_all[] = {Trust::certified, Trust::bound_assumed, Trust::heuristic,
                                       Trust::unknown};
            const auto known_trust =
                std::ranges::find(k_all, trust, [](Trust t) { return std::string(to_string(t)); });
            if (known_trust == std::end(k_all))
                wrong(at + "/trust", "must be one of certified, bound assumed, heuristic, unknown");
            else
                found.trust = *known_trust;
        }
        found.settings = settings(json, "set", at);
        found.axes = axes(json, at);
        return found;
    }

    bool doubles(const Json& json, const std::string& at) {
        if (!json.is_object() || !json.contains("precision"))
            return false;
        const std::string precision = string_of(json["precision"], at + "/precision");
        if (precision != "single" && precision != "double")
            wrong(at + "/precision", "must be single or double");
        return precision == "double";
    }

    Promise promise(const Json& json) {
        known(json, "/promise", {"wrong_percent", "psnr"});
        Promise found;
        if (json.is_object() && json.contains("wrong_percent"))
            found.most_wrong_percent = number_of(json["wrong_percent"], "/promise/wrong_percent");
        if (json.is_object() && json.contains("psnr"))
            found.least_psnr = number_of(json["psnr"], "/promise/psnr");
        return found;
    }

    const std::string& file_;
    std::string_view text_;
    std::optional<Error> error_;
};

} // namespace

Result<Study> parse_study(std::string_view text, const std::string& file) {
    const auto json = TRY(scene::parse_json(text, file));
    return Reader(file, text).read(json);
}

} // namespace tidemark::lab
