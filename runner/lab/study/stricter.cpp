#include "lab/study/stricter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tidemark::lab {

std::optional<double> number_of(const std::string& text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool whole_text = error == std::errc{} && end == text.data() + text.size();
    return whole_text && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

bool is_int(const std::string& number) {
    return number.find_first_of(".eE") == std::string::npos;
}

namespace {

std::string float_text(double number) {
    std::string text = fmt::format("{:.9g}", number);
    return is_int(text) ? text + ".0" : text;
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
    return scaled(axis.values.back(),
                  std::pow(*ratio > 1 ? std::max(*ratio, 2.0) : std::min(*ratio, 0.5), steps));
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
            const long long odd = (was - is) % 2 != 0 ? is : is + one;
            value = fmt::format("{}", std::max(odd + (second ? one : 0), 1LL));
        }
        setting.value = *std::move(value);
    }
    return settings;
}

} // namespace tidemark::lab
