#include "host/overlay_model.hpp"

#include "base/encoding.hpp"
#include "base/overloaded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace tidemark::overlay {
using scene::Knob;
using scene::KnobType;
namespace {

/// Returns the byte offset of the character with that index (from 0) in UTF-8.
size_t byte_of(std::string_view text, size_t character) {
    size_t i = 0;
    for (; i < text.size(); ++i)
        if (!continues_character(text[i]) && character-- == 0)
            break;
    return i;
}

bool has_length(const scene::KnobRange& range) {
    for (size_t i = 0; i < range.low.size(); ++i)
        if (!std::isfinite(2 * range.low[i]) || !std::isfinite(2 * range.high[i]))
            return false;
    return true;
}

} // namespace

std::optional<DefinitionField> definition_field(std::string_view name, std::string_view text, bool held) {
    DefinitionField field{.name = std::string(name), .held = held};
    const std::string_view digits = text.substr(text.starts_with('+') ? 1 : 0);
    const auto value = number_from<double>(digits);
    if (!value || !std::isfinite(*value))
        return std::nullopt;
    field.value = *value;
    field.whole = digits.find_first_of(".eE") == std::string_view::npos;
    return field;
}

void keep_changing(const std::vector<DefinitionField>& before, std::vector<DefinitionField>& now) {
    for (DefinitionField& field : now) {
        const auto old = std::ranges::find(before, field.name, &DefinitionField::name);
        if (old != before.end() && old->changing) {
            field.value = old->value;
            field.changing = true;
        }
    }
}

std::string text_of(const DefinitionField& field) {
    if (field.whole)
        return fmt::format("{:.0f}", field.value);
    return float_literal(fmt::format("{}", field.value));
}

Excerpt excerpt_of(std::string_view line, int column, size_t most) {
    std::string text(line);
    std::ranges::replace(text, '\t', ' ');
    const size_t before = std::min(text.size(), size_t(std::max(column - 1, 0)));
    const auto place = size_t(
        std::count_if(text.begin(), text.begin() + std::ptrdiff_t(before), std::not_fn(continues_character)));
    const size_t first = place < most ? 0 : place - most / 2;
    const size_t begin = byte_of(text, first);
    text = text.substr(begin, byte_of(std::string_view(text).substr(begin), most));
    return {std::move(text), column > 0 ? std::string(place - first, ' ') + "^" : ""};
}

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

std::string number_text(float value) {
    if (std::isnan(value))
        return "NaN";
    if (std::isinf(value))
        return value < 0 ? "-Inf" : "Inf";
    return fmt::format("{:.7g}", value);
}

std::string bits_text(float value) {
    return fmt::format("{:#010x}", std::bit_cast<uint32_t>(value));
}

MagnifierField::Colour colour_of(const float* rgb) {
    MagnifierField::Colour colour;
    for (size_t i = 0; i < colour.size(); ++i) {
        const float value = std::isnan(rgb[i]) ? 0 : std::clamp(rgb[i], 0.0F, 1.0F);
        colour[i] = static_cast<unsigned char>(std::lround(value * 255));
    }
    return colour;
}

double bar_end(const TimeField& time) {
    const double needed = std::max(time.seconds, time.loop_to.value_or(0));
    double end = 10;
    while (end < needed)
        end *= 2;
    return end;
}

bool EventOwner::take(const host::InputEvent& event, const Wishes& wishes) {
    return std::visit(
        Overloaded{
            [&](const host::PointerMoved&) { return !buttons_.empty(); },
            [&](const host::ButtonPressed& pressed) {
                return wishes.pointer && buttons_.insert(pressed.button).second;
            },
            [&](const host::ButtonReleased& released) { return buttons_.erase(released.button) > 0; },
            [&](const host::WheelTurned&) { return wishes.pointer; },
            [&](const host::KeyPressed& pressed) {
                if (wishes.text)
                    keys_.insert(pressed.key);
                return wishes.text;
            },
            [&](const host::KeyReleased& released) { return keys_.erase(released.key) > 0; },
            [&](const host::TextTyped&) { return wishes.text; },
            [](const auto&) { return false; },
        },
        event);
}

void EventOwner::release_all() {
    buttons_.clear();
    keys_.clear();
}

} // namespace tidemark::overlay
