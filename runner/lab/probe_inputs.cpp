#include "lab/probe_inputs.hpp"

#include "base/error.hpp"
#include "lab/scene_numbers.hpp"
#include "scene/scene.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace tidemark::lab {
namespace {

using PromiseJson = nlohmann::json;

struct Field {
    std::string_view name;
    double Promises::*value;
};

constexpr Field k_fields[] = {
    {"time_horizon", &Promises::time_horizon},
    {"most_exhausted_percent", &Promises::most_exhausted_percent},
    {"most_overstep_percent", &Promises::most_overstep_percent},
    {"smoothest_jump", &Promises::smoothest_jump},
    {"space_horizon", &Promises::space_horizon},
    {"largest_slope", &Promises::largest_slope},
};

std::string names() {
    std::string text;
    for (const Field& field : k_fields)
        text += fmt::format("{}, ", field.name);
    return text + "ranges, skip, when";
}

std::string take_reasons(Promises& promises, const PromiseJson& reasons) {
    if (!reasons.is_object())
        return R"('skip' takes {"probe": "why"})";
    for (const auto& [probe, reason] : reasons.items()) {
        if (!reason.is_string())
            return R"('skip' takes {"probe": "why"})";
        promises.skip[probe] = reason.get<std::string>();
    }
    return {};
}

std::string take_ranges(Promises& promises, const PromiseJson& ranges) {
    constexpr const char* k_form = "'ranges' takes {\"knob\": [low, high]}";
    if (!ranges.is_object())
        return k_form;
    for (const auto& [knob, range] : ranges.items()) {
        if (!range.is_array() || range.size() != 2 || !range[0].is_number() || !range[1].is_number() ||
            range[0].get<double>() > range[1].get<double>())
            return k_form;
        promises.ranges[knob] = {range[0].get<double>(), range[1].get<double>()};
    }
    return {};
}

/// Sets one number.
std::string take_number(Promises& promises, const std::string& name, const PromiseJson& value) {
    const auto field = std::ranges::find(k_fields, name, &Field::name);
    if (field == std::end(k_fields))
        return fmt::format("'{}' is not a known promise; there are {}", name, names());
    if (!value.is_number() || !(value.get<double>() >= 0))
        return fmt::format("'{}' takes a number of 0 or more", name);
    promises.*(field->value) = value.get<double>();
    promises.stated.insert(name);
    return {};
}

/// Applies one entry; returns what is wrong with it, or an empty text.
std::string take(Promises& promises, const std::string& name, const PromiseJson& value) {
    return name == "skip"     ? take_reasons(promises, value)
           : name == "ranges" ? take_ranges(promises, value)
                              : take_number(promises, name, value);
}

/// Applies the entries whose definition holds. The others are parsed as well, so that their errors are
/// reported.
std::string take_conditional(Promises& promises, const PromiseJson& conditional,
                             const DefinitionOf& definition_of) {
    constexpr const char* k_form = "'when' takes {\"NAME=VALUE\": {promises}}";
    if (!conditional.is_object())
        return k_form;
    for (const auto& [condition, entries] : conditional.items()) {
        const size_t equals = condition.find('=');
        if (equals == condition.npos || !entries.is_object())
            return k_form;
        const bool holds = definition_of(condition.substr(0, equals)) == condition.substr(equals + 1);
        Promises unused;
        for (const auto& [name, value] : entries.items())
            if (std::string wrong = take(holds ? promises : unused, name, value); !wrong.empty())
                return wrong;
    }
    return {};
}

/// Applies all entries; returns what is wrong with the first invalid one, or an empty text.
std::string take_all(Promises& promises, const PromiseJson& entries, const DefinitionOf& definition_of) {
    for (const auto& [name, value] : entries.items())
        if (name != "when")
            if (std::string wrong = take(promises, name, value); !wrong.empty())
                return wrong;
    // Conditional entries come last: they override the plain ones, in any order of the file.
    return entries.contains("when") ? take_conditional(promises, entries["when"], definition_of) : "";
}

} // namespace

Result<Promises> parse_promises(std::string_view text, const std::string& file,
                                const DefinitionOf& definition_of) {
    const PromiseJson json = PromiseJson::parse(text, nullptr, false, true);
    if (!json.is_object())
        return fail(ErrorCode::load, fmt::format("{}: not a JSON object", file));
    Promises promises;
    if (const std::string wrong = take_all(promises, json, definition_of); !wrong.empty())
        return fail(ErrorCode::load, fmt::format("{}: {}", file, wrong));
    return promises;
}

FrameState state_at(double seconds, Extent extent) {
    return render::at_time(seconds, {.extent = extent});
}

FrameState state_at_float(double seconds, FrameState state) {
    return render::at_time(double(float(seconds + 1.0 / 3)), std::move(state));
}

FrameState plain_state(Extent extent) {
    return state_at(1, extent);
}

std::vector<FrameState> usual_moments() {
    std::vector<FrameState> states;
    for (const double time :
         {0.0, 1e-6, 1.0, 60.0, 62.83 - 1 / 60.0, 62.83 + 1 / 60.0, 1e3, 1e4, 1e5, 1e6, 16777216.0, -5.0})
        states.push_back(state_at(time));
    return states;
}

FrameState with_mouse(render::Mouse mouse, FrameState state) {
    state.mouse = mouse;
    return state;
}

int first_frame_of(const FrameState& state) {
    constexpr int k_run_up = 8;
    return state.time ? std::max(state.frame - k_run_up, 0) : 0;
}

Result<scene::Scene> in_state(scene::Scene scene, const FrameState& state) {
    for (const std::string& channel : state.channels)
        TRY(scene::override_channel(scene, channel));
    for (const scene::KnobSetting& setting : state.knobs)
        TRY(scene::set_knob(scene.knobs, setting));
    return with(std::move(scene), state.definitions);
}

namespace {

constexpr size_t k_text_numbers = 40; ///< most moments taken from the text
constexpr int k_early_moments = 128;  ///< in the first k_early seconds
constexpr double k_early = 128;
constexpr int k_late_moments = 32; ///< from k_early to k_latest_seconds seconds
constexpr double k_latest_seconds = 1e5;
constexpr int k_knob_values = 8; ///< of each component
constexpr size_t k_most_knob_values = 128;
constexpr int k_mouse_places = 32;
constexpr int k_mixed = 48;

/// Returns element i of a sequence whose every prefix is spread evenly over [0, 1).
double even_part(int i, double step) {
    double whole = 0;
    return std::modf(0.5 + i * step, &whole);
}
constexpr double k_golden = 0.6180339887498949;
/// Steps for two coordinates at once.
constexpr double k_plastic[] = {0.7548776662466927, 0.5698402909980532};

/// Rounds to a multiple of `step`, so that moments and values in messages stay short.
double rounded(double value, double step) {
    return std::round(value / step) * step;
}

/// Returns numbers of the text, those in a statement with iTime first, then the midpoints between neighbours.
std::vector<double> moments_of_text(const scene::Scene& scene) {
    std::vector<double> numbers;
    const auto add = [&](double value) {
        if (value > 0 && value <= 1e6 && numbers.size() < k_text_numbers &&
            std::ranges::find(numbers, value) == numbers.end())
            numbers.push_back(value);
    };
    const auto all = text_numbers(scene);
    for (const bool beside_time : {true, false})
        for (const TextNumber& number : all)
            if (number.beside_time == beside_time)
                add(number.value);
    std::vector<double> sorted = numbers;
    std::ranges::sort(sorted);
    for (size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i] > 1)
            numbers.push_back((sorted[i - 1] + sorted[i]) / 2);
    return numbers;
}

std::vector<SearchAxis> axes_of(const scene::Scene& scene, const Promises& promises, SearchInputs inputs) {
    std::vector<SearchAxis> axes;
    if (inputs.time)
        axes.push_back({SearchAxis::Kind::time});
    for (size_t i = 0; i < scene.knobs.size(); ++i) {
        const scene::Knob& knob = scene.knobs[i];
        const auto promised = promises.ranges.find(knob.name);
        if (!knob.range && promised == promises.ranges.end())
            continue;
        for (size_t part = 0; part < size_t(scene::info(knob.type).components); ++part)
            axes.push_back(
                {SearchAxis::Kind::knob, i, part,
                 promised != promises.ranges.end() ? promised->second.first : knob.range->low[part],
                 promised != promises.ranges.end() ? promised->second.second : knob.range->high[part]});
    }
    for (size_t part = 0; inputs.mouse && part < 2; ++part)
        axes.push_back({SearchAxis::Kind::mouse, 0, part});
    return axes;
}

/// Merges the lists, each spread evenly over the result.
std::vector<SearchPoint> in_turn(std::vector<std::vector<SearchPoint>> lists) {
    std::vector<SearchPoint> points;
    size_t longest = 0;
    for (const auto& list : lists)
        longest = std::max(longest, list.size());
    // Each round takes a share of every list, so that all end together.
    for (size_t turn = 0; turn < longest; ++turn)
        for (auto& list : lists)
            for (size_t i = turn * list.size() / longest; i < (turn + 1) * list.size() / longest; ++i)
                points.push_back(list[i]);
    return points;
}

} // namespace

SearchSpace::SearchSpace(const scene::Scene& scene, const Promises& promises, SearchInputs inputs)
    : scene_(scene), inputs_(inputs), axes_(axes_of(scene, promises, inputs)) {}

SearchPoint SearchSpace::plain() const {
    SearchPoint point;
    for (const scene::Knob& knob : scene_.knobs)
        point.knobs.push_back(knob.value);
    return point;
}

std::vector<double> SearchSpace::moments() const {
    std::vector<double> moments;
    for (int i = 0; i < k_early_moments; ++i) {
        moments.push_back(rounded(k_early * even_part(i, k_golden), 1.0 / 64));
        if (constexpr int k_each = k_early_moments / k_late_moments; i % k_each == k_each - 1)
            moments.push_back(
                std::round(k_early * std::pow(k_latest_seconds / k_early, even_part(i / k_each, k_golden))));
    }
    return moments;
}

std::vector<SearchPoint> SearchSpace::survey() const {
    std::vector<SearchPoint> of_text, of_time, of_knobs, of_mouse, mixed;
    SearchPoint point = plain();
    const auto add_moments = [&](const std::vector<double>& moments, std::vector<SearchPoint>& to) {
        for (point.time = 1; const double moment : moments) {
            point.time = moment;
            to.push_back(point);
        }
        point = plain();
    };
    if (inputs_.time) {
        add_moments(moments_of_text(scene_), of_text);
        add_moments(moments(), of_time);
    }
    for (int i = 0; i < k_knob_values; ++i)
        for (const SearchAxis& axis : axes_)
            if (axis.kind == SearchAxis::Kind::knob && of_knobs.size() < k_most_knob_values) {
                point = plain();
                set(point, axis,
                    axis.low + (axis.high - axis.low) * rounded(even_part(i, k_golden), 1.0 / 64));
                of_knobs.push_back(point);
            }
    point = plain();
    for (int i = 0; inputs_.mouse && i < k_mouse_places; ++i) {
        point.mouse = {even_part(i, k_plastic[0]), even_part(i, k_plastic[1])};
        point.down = i % 4 != 3;
        of_mouse.push_back(point);
    }
    std::mt19937 random(13);
    const auto lot = [&] { return double(random()) / 4294967296.0; };
    for (int i = 0; axes_.size() > 1 && i < k_mixed; ++i) {
        point = plain();
        for (const SearchAxis& axis : axes_)
            set(point, axis,
                axis.kind == SearchAxis::Kind::time ? rounded(k_early * lot(), 1.0 / 64)
                                                    : axis.low + (axis.high - axis.low) * lot());
        mixed.push_back(point);
    }
    auto points = in_turn({of_text, of_time, of_knobs, of_mouse, mixed});
    points.insert(points.begin(), plain());
    return points;
}

FrameState SearchSpace::state(const SearchPoint& point, Extent extent) const {
    FrameState state = state_at(point.time, extent);
    for (size_t i = 0; i < scene_.knobs.size(); ++i) {
        const scene::Knob& knob = scene_.knobs[i];
        scene::KnobValue value = point.knobs[i];
        if (scene::info(knob.type).whole)
            std::ranges::transform(value, value.begin(), [](double part) { return std::floor(part); });
        if (knob.value != value)
            state.knobs.push_back(scene::setting_of(knob, value));
    }
    if (point.mouse)
        state.mouse =
            render::Mouse::clicked(*point.mouse * glm::dvec2(extent.width, extent.height), point.down);
    return state;
}

double SearchSpace::value(const SearchPoint& point, const SearchAxis& axis) {
    switch (axis.kind) {
    case SearchAxis::Kind::time: return point.time;
    case SearchAxis::Kind::knob: return point.knobs[axis.knob][axis.component];
    case SearchAxis::Kind::mouse:
        return point.mouse ? (axis.component == 0 ? point.mouse->x : point.mouse->y) : 0.5;
    }
    return 0;
}

void SearchSpace::set(SearchPoint& point, const SearchAxis& axis, double value) {
    switch (axis.kind) {
    case SearchAxis::Kind::time: point.time = value; return;
    case SearchAxis::Kind::knob: point.knobs[axis.knob][axis.component] = value; return;
    case SearchAxis::Kind::mouse:
        if (!point.mouse)
            point.mouse = {0.5, 0.5};
        (axis.component == 0 ? point.mouse->x : point.mouse->y) = value;
    }
}

} // namespace tidemark::lab
