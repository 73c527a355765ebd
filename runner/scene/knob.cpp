#include "scene/knob.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/mapped_text.hpp"
#include "base/tokens.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>

namespace tidemark::scene {

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
    const auto value = number_from<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

constexpr std::string_view k_default_value = "default";

std::optional<GivenValue> parse_hex_colour(std::string_view text) {
    unsigned packed = 0;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), packed, 16);
    if (text.size() != 7 || error != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return GivenValue{
        3,
        {double(packed >> 16) / 255, double(packed >> 8 & 255) / 255, double(packed & 255) / 255, 0},
        KnobType::color3};
}

/// Parses numbers separated by commas; nullopt if one is not a number or there are more than four.
std::optional<GivenValue> parse_list(std::string_view text) {
    GivenValue given;
    while (true) {
        const size_t comma = text.find(',');
        const auto number = parse_number(text.substr(0, comma));
        if (!number || size_t(given.count) == given.numbers.size())
            return std::nullopt;
        given.numbers[size_t(given.count++)] = *number;
        if (comma == std::string_view::npos)
            return given;
        text.remove_prefix(comma + 1);
    }
}

/// Returns the type and the text between the parentheses of `vec3(…)`; no type and the whole text if it does
/// not have that form.
std::pair<std::optional<KnobType>, std::string_view> split_constructor(std::string_view text) {
    for (const KnobTypeInfo& type : k_types) {
        if (!text.starts_with(type.directive_name))
            continue;
        const std::string_view rest = trimmed(text.substr(type.directive_name.size()));
        if (rest.starts_with('(') && rest.ends_with(')'))
            return {type.type, rest.substr(1, rest.size() - 2)};
    }
    return {std::nullopt, text};
}

/// Parses a trimmed text; nullopt if it has none of the forms of a value.
std::optional<GivenValue> parse_given(std::string_view text) {
    if (text == k_default_value)
        return GivenValue{};
    if (text.starts_with('#'))
        return parse_hex_colour(text);
    const auto [type, numbers] = split_constructor(text);
    auto given = parse_list(numbers);
    if (given)
        given->type = type;
    return given;
}

/// Returns the knob's value; nullopt if it does not accept that one.
std::optional<KnobValue> accepted(const Knob& knob, const GivenValue& given) {
    const KnobTypeInfo& type = info(knob.type);
    if (given.count == 0)
        return knob.initial;
    if (given.count != 1 && given.count != type.components)
        return std::nullopt;
    if (given.type) {
        const std::string_view named = info(*given.type).directive_name;
        if (named != type.directive_name && named != type.glsl_name)
            return std::nullopt;
    }
    KnobValue value{};
    for (size_t i = 0; i < size_t(type.components); ++i) {
        value[i] = given.numbers[given.count == 1 ? 0 : i];
        if (!std::isfinite(value[i]) ||
            (type.whole && (value[i] != std::trunc(value[i]) || !fits_int(value[i]))))
            return std::nullopt;
    }
    return value;
}

/// Returns the error for a value that the knob does not accept.
tl::unexpected<Error> refuse(const Knob& knob, std::string_view text) {
    const KnobTypeInfo& type = info(knob.type);
    const std::string_view kind = type.whole ? "whole number" : "number";
    std::string form = fmt::format("a {}", kind);
    if (type.components > 1)
        form = fmt::format("{} {}s, as in {}", type.components, kind,
                           std::string_view("1,2,3,4").substr(0, size_t(2 * type.components - 1)));
    if (knob.type == KnobType::color3)
        form += " or #rrggbb";
    return fail(ErrorCode::usage, fmt::format("'{}' is not a value for {} ({}): give {}", text, knob.name,
                                              type.directive_name, form));
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

Result<KnobSetting> parse_knob_setting(std::string_view name, std::string_view text) {
    text = trimmed(text);
    const auto given = parse_given(text);
    if (!given)
        return fail(
            ErrorCode::usage,
            fmt::format("'{}' is not a value for {}: give a number, up to four as in 1,2,3, #rrggbb or {}",
                        text, name, k_default_value));
    return KnobSetting{std::string(name), *given};
}

std::string to_string(const GivenValue& value) {
    if (value.count == 0)
        return std::string(k_default_value);
    const std::span<const double> numbers(value.numbers.data(), size_t(value.count));
    return value.type ? fmt::format("{}({})", info(*value.type).directive_name, fmt::join(numbers, ", "))
                      : fmt::format("{}", fmt::join(numbers, ","));
}

KnobSetting setting_of(const Knob& knob, const KnobValue& value) {
    const KnobTypeInfo& type = info(knob.type);
    GivenValue given{type.components};
    std::copy_n(value.begin(), type.components, given.numbers.begin());
    if (type.components > 1)
        given.type = find_knob_type(type.glsl_name)->type;
    return {knob.name, given};
}

Result<KnobValue> value_for(const Knob& knob, const GivenValue& given) {
    const auto value = accepted(knob, given);
    return value ? Result<KnobValue>(*value) : refuse(knob, to_string(given));
}

Result<KnobValue> parse_knob_value(const Knob& knob, std::string_view text) {
    text = trimmed(text);
    const auto given = parse_given(text);
    const auto value = given ? accepted(knob, *given) : std::nullopt;
    return value ? Result<KnobValue>(*value) : refuse(knob, text); // the text as it was written
}

Result<void> set_knob(std::vector<Knob>& knobs, const KnobSetting& setting) {
    Knob* const knob = TRY(find_knob(knobs, setting.name));
    knob->value = TRY(value_for(*knob, setting.value));
    return {};
}

KnobValue value_after(const Knob& knob, std::span<const KnobSetting> settings) {
    KnobValue value = knob.value;
    for (const KnobSetting& setting : settings)
        if (setting.name == knob.name)
            value = accepted(knob, setting.value).value_or(value);
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

std::string as_glsl(const Knob& knob, std::string_view type) {
    if (type == "bool")
        return knob.value[0] != 0 ? "true" : "false";
    return knob.type == KnobType::float1 ? float_literal(to_string(knob)) : to_string(knob);
}

std::string to_literal(const Knob& knob) {
    return to_text(knob, knob.value, info(knob.type).directive_name);
}

namespace {

using text::Token;

/// The default of a knob, as a range of byte offsets in a text.
struct DefaultPlace {
    size_t begin;
    size_t end;
    std::string_view type; ///< of a plain declaration
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

/// Returns the index of `iUniform` if the token is the name in `#iUniform TYPE NAME`, or of `uniform` if it
/// is a name in `uniform TYPE NAME`, for a plain knob.
std::optional<size_t> declaration_of(const std::vector<Token>& tokens, size_t name, bool plain) {
    if (!plain)
        return name >= 3 && tokens[name - 3].is("#") && tokens[name - 2].is("iUniform")
                   ? std::optional(name - 2)
                   : std::nullopt;
    for (size_t i = name; i-- > 0 && !tokens[i].is(";") && !tokens[i].is("}");)
        if (tokens[i].is("uniform"))
            return i;
    return std::nullopt;
}

/// Returns the index of the type's token, for a `uniform` at `first`.
size_t type_after(const std::vector<Token>& tokens, size_t first) {
    size_t i = first + 1;
    while (i < tokens.size() && (tokens[i].is("lowp") || tokens[i].is("mediump") || tokens[i].is("highp")))
        ++i;
    return i;
}

/// Returns the range from the end of a knob's name to the end of its default, if it has one.
std::optional<DefaultPlace> place_of_default(const std::vector<Token>& tokens, const Knob& knob) {
    for (size_t i = 0; i < tokens.size(); ++i) {
        const auto first = tokens[i].is(knob.name) ? declaration_of(tokens, i, knob.plain) : std::nullopt;
        if (!first)
            continue;
        const size_t next = i + 1;
        const bool has_default = next < tokens.size() && tokens[next].is("=");
        const size_t end = has_default ? end_of_value(tokens, next) : next;
        return DefaultPlace{tokens[i].end(), tokens[end - 1].end(), tokens[type_after(tokens, *first)].text};
    }
    return std::nullopt;
}

/// A declaration `uniform TYPE NAME = VALUE, NAME;`.
struct PlainUniforms {
    std::string_view type;
    std::vector<size_t> names; ///< indices of the tokens; empty: another form
};

PlainUniforms uniforms_at(const std::vector<Token>& tokens, size_t first) {
    PlainUniforms found;
    const size_t type = type_after(tokens, first);
    if (type >= tokens.size() || (first > 0 && tokens[first - 1].is(")"))) // a layout
        return found;
    found.type = tokens[type].text;
    for (size_t i = type + 1; i + 1 < tokens.size();) {
        found.names.push_back(i);
        i = tokens[i + 1].is("=") ? end_of_value(tokens, i + 1) : i + 1;
        if (i < tokens.size() && tokens[i].is(";"))
            return found;
        if (i >= tokens.size() || !tokens[i++].is(","))
            break;
    }
    return {};
}

} // namespace

Result<std::string> with_defaults(std::string_view text, const std::vector<Knob>& knobs) {
    std::string changed(text);
    for (const Knob& knob : knobs) {
        const std::vector<Token> tokens = text::tokenize(changed);
        const auto place = place_of_default(tokens, knob);
        if (!place)
            return fail(ErrorCode::write, fmt::format("there is no line '{} … {}' in it",
                                                      knob.plain ? "uniform" : "#iUniform", knob.name));
        changed.replace(place->begin, place->end - place->begin,
                        " = " + (knob.plain ? as_glsl(knob, place->type) : to_literal(knob)));
    }
    return changed;
}

std::vector<text::Edit> without_plain_defaults(std::string_view text, const std::vector<Knob>& knobs) {
    const std::vector<Token> tokens = text::tokenize(text);
    std::vector<text::Edit> edits;
    for (size_t i = 0; i + 1 < tokens.size(); ++i)
        if (tokens[i + 1].is("=") && declaration_of(tokens, i, true) &&
            std::ranges::any_of(knobs,
                                [&](const Knob& knob) { return knob.plain && tokens[i].is(knob.name); }))
            edits.push_back({tokens[i].end(), tokens[end_of_value(tokens, i + 1) - 1].end(), {}});
    return edits;
}

std::string with_plain_knobs_as_constants(std::string_view text, const std::vector<Knob>& knobs) {
    const auto find = [&](const Token& token) {
        return std::ranges::find_if(knobs,
                                    [&](const Knob& knob) { return knob.plain && token.is(knob.name); });
    };
    const std::vector<Token> tokens = text::tokenize(text);
    std::string changed(text);
    for (size_t i = tokens.size(); i-- > 0;) {
        if (!tokens[i].is("uniform"))
            continue;
        const PlainUniforms found = uniforms_at(tokens, i);
        if (found.names.empty() ||
            !std::ranges::all_of(found.names, [&](size_t name) { return find(tokens[name]) != knobs.end(); }))
            continue;
        for (size_t last = found.names.size(); last-- > 0;) {
            const size_t name = found.names[last];
            const bool has_value = tokens[name + 1].is("=");
            const size_t end = has_value ? end_of_value(tokens, name + 1) : name + 1;
            const size_t begin = tokens[name].end();
            changed.replace(begin, tokens[end - 1].end() - begin,
                            " = " + as_glsl(*find(tokens[name]), found.type));
        }
        changed.replace(tokens[i].begin, tokens[i].end() - tokens[i].begin, "const");
    }
    return changed;
}

} // namespace tidemark::scene
