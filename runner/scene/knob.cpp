#include "scene/knob.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/tokens.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>

namespace tidemark::scene {

void set(std::vector<Setting>& settings, const Setting& setting) {
    const auto known = std::ranges::find(settings, setting.name, &Setting::name);
    if (known == settings.end())
        settings.push_back(setting);
    else
        *known = setting;
}

namespace {

constexpr std::array<KnobTypeInfo, 9> k_types{{
    {KnobType::float1, "float", "float", 1, false},
    {KnobType::vec2, "vec2", "vec2", 2, false},
    {KnobType::vec3, "vec3", "vec3", 3, false},
    {KnobType::vec4, "vec4", "vec4", 4, false},
    {KnobType::color3, "color3", "vec3", 3, false},
    {KnobType::int1, "int", "int", 1, true},
    {KnobType::ivec2, "ivec2", "ivec2", 2, true},
    {KnobType::ivec3, "ivec3", "ivec3", 3, true},
    {KnobType::ivec4, "ivec4", "ivec4", 4, true},
}};

std::optional<double> parse_number(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+') && !text.starts_with("+-"))
        text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::optional<KnobValue> parse_hex_colour(std::string_view text) {
    unsigned packed = 0;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), packed, 16);
    if (text.size() != 7 || error != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return KnobValue{double(packed >> 16) / 255, double(packed >> 8 & 255) / 255, double(packed & 255) / 255,
                     0};
}

/// Parses numbers separated by commas; nullopt if one is not a number or there are more than four.
std::optional<std::vector<double>> parse_list(std::string_view text) {
    std::vector<double> numbers;
    while (true) {
        const size_t comma = text.find(',');
        const auto number = parse_number(text.substr(0, comma));
        if (!number || numbers.size() == 4)
            return std::nullopt;
        numbers.push_back(*number);
        if (comma == std::string_view::npos)
            return numbers;
        text.remove_prefix(comma + 1);
    }
}

/// Returns the text between the parentheses of `vec3(…)`; the whole text if it does not have that form.
std::string_view without_constructor(std::string_view text, const KnobTypeInfo& type) {
    for (const std::string_view name : {type.directive_name, type.glsl_name}) {
        std::string_view rest = text;
        if (!rest.starts_with(name))
            continue;
        rest = trimmed(rest.substr(name.size()));
        if (rest.starts_with('(') && rest.ends_with(')'))
            return rest.substr(1, rest.size() - 2);
    }
    return text;
}

} // namespace

const KnobTypeInfo& info(KnobType type) {
    return k_types[size_t(type)];
}

const KnobTypeInfo* find_knob_type(std::string_view directive_name) {
    const auto found = std::find_if(k_types.begin(), k_types.end(), [&](const KnobTypeInfo& candidate) {
        return candidate.directive_name == directive_name;
    });
    return found == k_types.end() ? nullptr : &*found;
}

Result<KnobValue> parse_knob_value(const Knob& knob, std::string_view text) {
    const KnobTypeInfo& type = info(knob.type);
    const auto refuse = [&] {
        const std::string_view kind = type.whole ? "whole number" : "number";
        std::string form = fmt::format("a {}", kind);
        if (type.components > 1)
            form = fmt::format("{} {}s, as in {}", type.components, kind,
                               std::string_view("1,2,3,4").substr(0, size_t(2 * type.components - 1)));
        if (knob.type == KnobType::color3)
            form += " or #rrggbb";
        return fail(ErrorCode::usage, fmt::format("'{}' is not a value for {} ({}): give {}", text, knob.name,
                                                  type.directive_name, form));
    };
    text = trimmed(text);
    if (text == k_default_value)
        return knob.initial;
    if (knob.type == KnobType::color3 && text.starts_with('#')) {
        const auto colour = parse_hex_colour(text);
        return colour ? Result<KnobValue>(*colour) : refuse();
    }
    const auto numbers = parse_list(without_constructor(text, type));
    if (!numbers || (numbers->size() != 1 && numbers->size() != size_t(type.components)))
        return refuse();
    KnobValue value{};
    for (size_t i = 0; i < size_t(type.components); ++i) {
        value[i] = (*numbers)[numbers->size() == 1 ? 0 : i];
        if (type.whole && (value[i] != std::trunc(value[i]) || !fits_int(value[i])))
            return refuse();
    }
    return value;
}

KnobValue value_after(const Knob& knob, std::span<const Setting> settings) {
    KnobValue value = knob.value;
    for (const Setting& setting : settings)
        if (setting.name == knob.name)
            value = parse_knob_value(knob, setting.value).value_or(value);
    return value;
}

Result<Knob*> find_knob(std::vector<Knob>& knobs, std::string_view name) {
    const auto found =
        std::find_if(knobs.begin(), knobs.end(), [&](const Knob& knob) { return knob.name == name; });
    if (found != knobs.end())
        return &*found;
    std::vector<std::string> names;
    for (const Knob& knob : knobs)
        names.push_back(knob.name);
    return fail(ErrorCode::usage, fmt::format("the scene has no knob '{}': {}", name,
                                              hint_for(name, names, "it declares none with #iUniform")));
}

namespace {

std::string to_text(const Knob& knob, const KnobValue& value, std::string_view constructor) {
    const int count = info(knob.type).components;
    const std::span<const double> components(value.data(), size_t(count));
    return count == 1 ? fmt::format("{}", components[0])
                      : fmt::format("{}({})", constructor, fmt::join(components, ", "));
}

} // namespace

std::string to_string(const Knob& knob, const KnobValue& value) {
    return to_text(knob, value, info(knob.type).glsl_name);
}

std::string to_literal(const Knob& knob) {
    return to_text(knob, knob.value, info(knob.type).directive_name);
}

namespace {

using text::Token;

/// A range of byte offsets in a text.
struct Span {
    size_t begin;
    size_t end;
};

/// Returns the index after the tokens of `= VALUE`, with `equals` at the `=`: a number with its sign, or
/// `TYPE(…)`.
size_t end_of_value(const std::vector<Token>& tokens, size_t equals) {
    size_t i = equals + 1;
    if (i < tokens.size() && (tokens[i].is("-") || tokens[i].is("+")))
        ++i;
    ++i;
    if (i >= tokens.size() || !tokens[i].is("("))
        return std::min(i, tokens.size());
    while (i < tokens.size() && !tokens[i].is(")"))
        ++i;
    return std::min(i + 1, tokens.size());
}

/// Returns the range from the end of a knob's name to the end of its default, if it has one.
std::optional<Span> place_of_default(const std::vector<Token>& tokens, std::string_view name) {
    for (size_t i = 0; i + 3 < tokens.size(); ++i) {
        if (!tokens[i].is("#") || !tokens[i + 1].is("iUniform") || !tokens[i + 3].is(name))
            continue;
        const size_t behind = i + 4;
        const bool has_default = behind < tokens.size() && tokens[behind].is("=");
        const size_t end = has_default ? end_of_value(tokens, behind) : behind;
        return Span{tokens[i + 3].end(), tokens[end - 1].end()};
    }
    return std::nullopt;
}

} // namespace

Result<std::string> with_defaults(std::string_view text, const std::vector<Knob>& knobs) {
    std::string changed(text);
    for (const Knob& knob : knobs) {
        const auto place = place_of_default(text::tokenize(changed), knob.name);
        if (!place)
            return fail(ErrorCode::write, fmt::format("there is no line '#iUniform … {}' in it", knob.name));
        changed.replace(place->begin, place->end - place->begin, " = " + to_literal(knob));
    }
    return changed;
}

} // namespace tidemark::scene
