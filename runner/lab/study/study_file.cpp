#include "base/try.hpp"
#include "lab/study/study.hpp"
#include "scene/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::lab {
namespace {

using scene::Json;

/// Reads a JSON tree from the top, and keeps the first error with its place.
class Reader {
public:
    Reader(const std::string& file, std::string_view text) : file_(file), text_(text) {}

    Result<Study> read(const Json& json) {
        Study study;
        known(json, "",
              {"about", "size", "views", "series", "reference", "sources", "model", "omissions", "promise"});
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
                                                          ? "a study knows nothing of that name"
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
                wrong(at + "/mouse", "must be [x, y] in parts of the picture");
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
                wrong(at + "/trust", "is one of certified, bound assumed, heuristic, unknown");
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
            wrong(at + "/precision", "is single or double");
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
