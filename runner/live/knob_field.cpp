#include "live/knob_field.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::live {

using scene::Knob;
using scene::KnobType;

namespace {

bool has_length(const scene::KnobRange& range) {
    for (size_t i = 0; i < range.low.size(); ++i)
        if (!std::isfinite(2 * range.low[i]) || !std::isfinite(2 * range.high[i]))
            return false;
    return true;
}

} // namespace

Widget widget_of(const Knob& knob) {
    if (knob.type == KnobType::color3)
        return Widget::colour;
    if (!knob.range || !has_length(*knob.range))
        return Widget::drag;
    const bool two_values = knob.step && knob.range->high[0] - knob.range->low[0] == (*knob.step)[0];
    return info(knob.type).components == 1 && two_values ? Widget::check_box : Widget::slider;
}

bool takes(const Knob& knob, double number) {
    return std::isfinite(number) && (!info(knob.type).whole || scene::fits_int(number));
}

double in_steps(const Knob& knob, size_t component, double number) {
    const double step = knob.step ? (*knob.step)[component] : 0;
    if (!(step > 0))
        return number;
    const double origin = knob.range ? knob.range->low[component] : 0;
    const double stepped = origin + std::round((number - origin) / step) * step;
    // Remove the extra digits that the sum of an origin and steps like 0.1 has.
    constexpr double k_digits = 1e9;
    const double per_unit = k_digits / std::pow(10, std::ceil(std::log10(step)));
    return std::round(stepped * per_unit) / per_unit;
}

double drag_speed(const Knob& knob, size_t component) {
    constexpr double k_share = 0.005;
    const double speed = k_share * std::max(std::abs(knob.initial[component]), 1.0);
    return knob.step ? std::max(speed, (*knob.step)[component] / 10) : speed;
}

} // namespace tidemark::live
