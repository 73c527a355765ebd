#include "lab/scene_numbers.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/tokens.hpp"
#include "scene/scene.hpp"
#include "shader/definitions.hpp"
#include "shader/parsed_text.hpp"
#include "shader/shader_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <span>

namespace tidemark::lab {

std::vector<DefinedNumber> defined_numbers(const scene::Scene& scene) {
    std::vector<DefinedNumber> numbers;
    for (const std::string& name : glsl::definition_names(scene)) {
        const std::string text = glsl::definition_of(scene, name).value_or("");
        if (const auto value = number_from<double>(text))
            numbers.push_back({name, *value, text.find_first_of(".eE") == text.npos});
    }
    return numbers;
}

std::vector<DefinedNumber> defined_numbers(const scene::Scene& scene,
                                           std::initializer_list<std::string_view> words) {
    std::vector<DefinedNumber> numbers = defined_numbers(scene);
    std::erase_if(numbers, [&](const DefinedNumber& each) { return !speaks_of(each.name, words); });
    return numbers;
}

std::vector<TextNumber> text_numbers(const scene::Scene& scene) {
    std::vector<TextNumber> numbers;
    const auto read = [&](const text::MappedText& text) {
        size_t statement = numbers.size();
        bool beside_time = false;
        const auto close = [&] {
            for (; statement < numbers.size(); ++statement)
                numbers[statement].beside_time = beside_time;
            beside_time = false;
        };
        for (const text::Token& token : text::tokenize(text.text())) {
            double number = 0;
            if (token.text == ";" || token.text == "{" || token.text == "}")
                close();
            else if (token.kind == text::TokenKind::identifier)
                beside_time = beside_time || token.text == "iTime";
            else if (token.kind == text::TokenKind::number &&
                     std::from_chars(token.text.data(), token.text.data() + token.text.size(), number).ec ==
                         std::errc{})
                numbers.push_back({number, false, text.lines().locate(token.line, token.column)});
        }
        close();
    };
    read(scene.common);
    for (const scene::Pass& pass : scene.passes)
        read(pass.text);
    return numbers;
}

std::vector<SourceLocation> places_of_number(const scene::Scene& scene, double number) {
    std::vector<SourceLocation> beside, all;
    for (const TextNumber& each : text_numbers(scene))
        if (each.value == number) {
            all.push_back(each.where);
            if (each.beside_time)
                beside.push_back(each.where);
        }
    return beside.empty() ? all : beside;
}

bool speaks_of(std::string_view name, std::initializer_list<std::string_view> words) {
    const std::string lower = lower_case(std::string(name));
    return std::ranges::any_of(words, [&](std::string_view word) { return lower.find(word) != lower.npos; });
}

namespace {

/// Removes a trailing `:N` from `text` and returns N, or returns 0 if there is none.
int take_number(std::string_view& text) {
    const size_t colon = text.rfind(':');
    if (colon == text.npos)
        return 0;
    const int number = number_from<int>(text.substr(colon + 1)).value_or(0);
    if (number < 1)
        return 0;
    text = text.substr(0, colon);
    return number;
}

std::optional<SourceLocation> place_of(std::string_view name) {
    const int column = take_number(name);
    const int line = column > 0 ? take_number(name) : 0;
    return line > 0 ? std::optional(SourceLocation{std::string(name), line, column}) : std::nullopt;
}

std::optional<glsl::WrittenWord> number_in(const text::MappedText& text, const SourceLocation& place) {
    for (const text::Token& token : text::tokenize(text.text()))
        if (token.kind == text::TokenKind::number && text.lines().locate(token.line, token.column) == place)
            return glsl::WrittenWord{place, std::string(token.text)};
    return std::nullopt;
}

} // namespace

std::string place_name(const SourceLocation& where) {
    return fmt::format("{}:{}:{}", where.file, where.line, where.column);
}

std::optional<glsl::WrittenWord> number_at(const scene::Scene& scene, std::string_view name) {
    const auto place = place_of(name);
    if (!place)
        return std::nullopt;
    auto found = number_in(scene.common, *place);
    for (size_t i = 0; !found && i < scene.passes.size(); ++i)
        found = number_in(scene.passes[i].text, *place);
    return found;
}

glsl::Cure replaced(const glsl::WrittenWord& number, const std::string& value) {
    return {{{number, number, value, "", true}}, ""};
}

std::vector<scene::Setting> own_numbers(const scene::Scene& scene) {
    const bool bare = scene.image().bare_file;
    std::vector<scene::Setting> numbers;
    for (const glsl::NamedText& definition : glsl::plain_numbers(scene))
        if (!bare || definition.file == scene.file.string())
            numbers.push_back({definition.name, definition.text});
    for (const scene::Knob& knob : scene.knobs)
        numbers.push_back({knob.name, scene::to_string(knob)});
    return numbers;
}

namespace {

/// Splits at commas outside parentheses and trims the parts.
std::vector<std::string> split(std::string_view text) {
    std::vector<std::string> parts;
    int depth = 0;
    size_t begin = 0;
    for (size_t i = 0; i <= text.size(); ++i) {
        if (i < text.size() && (text[i] == '(' || text[i] == ')'))
            depth += text[i] == '(' ? 1 : -1;
        if (i < text.size() && (text[i] != ',' || depth > 0))
            continue;
        parts.emplace_back(trimmed(text.substr(begin, i - begin)));
        begin = i + 1;
    }
    return parts;
}

Error no_such_name(const scene::Scene& scene, std::string_view name) {
    std::vector<std::string> names = glsl::definition_names(scene);
    for (const scene::Knob& knob : scene.knobs)
        names.push_back(knob.name);
    return {ErrorCode::usage,
            fmt::format("the scene has no #iUniform, #define or const '{}': {}", name,
                        hint_for(name, names, "it has none at all")),
            {}};
}

/// Applies the change to all texts; returns false if one of them no longer contains the number.
bool replace(scene::Scene& scene, const glsl::Cure& number) {
    bool whole = glsl::apply(scene.common, std::span(&number, 1));
    for (scene::Pass& pass : scene.passes)
        whole = glsl::apply(pass.text, std::span(&number, 1)) && whole;
    return whole;
}

} // namespace

Result<Axis> parse_axis(std::string_view text, std::string_view option) {
    const size_t equals = text.find('=');
    Axis axis;
    if (equals != text.npos) {
        axis.name = trimmed(text.substr(0, equals));
        axis.values = split(text.substr(equals + 1));
    }
    const bool gap = std::ranges::any_of(axis.values, [](const std::string& value) { return value.empty(); });
    if (axis.name.empty() || axis.values.empty() || gap)
        return fail(ErrorCode::usage,
                    fmt::format("{} {}: give NAME=a,b,c, none of them empty", option, text));
    return axis;
}

Result<std::vector<Setting>> parse_settings(std::string_view text, std::string_view option) {
    std::vector<Setting> settings;
    for (const std::string& part : split(text)) {
        auto axis = parse_axis(part, option);
        if (!axis)
            return fail(ErrorCode::usage, fmt::format("{} {}: give NAME=V or NAME=V,NAME=V", option, text));
        settings.push_back({axis->name, axis->values.front()});
    }
    return settings;
}

std::vector<Setting> merged(const std::vector<Setting>& settings) {
    std::vector<Setting> last;
    for (const Setting& setting : settings) {
        const auto known = std::ranges::find(last, setting.name, &Setting::name);
        if (known != last.end())
            known->value = setting.value;
        else
            last.push_back(setting);
    }
    return last;
}

std::string to_string(const std::vector<Setting>& settings) {
    std::string text;
    for (const Setting& setting : settings)
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", setting.name, setting.value);
    return text.empty() ? "defaults" : text;
}

std::string to_string(const std::vector<scene::KnobSetting>& settings) {
    std::vector<Setting> texts;
    for (const scene::KnobSetting& setting : settings)
        texts.push_back({setting.name, scene::to_string(setting.value)});
    return to_string(texts);
}

bool is_knob(const scene::Scene& scene, std::string_view name) {
    return std::ranges::find(scene.knobs, name, &scene::Knob::name) != scene.knobs.end();
}

Result<void> apply(scene::Scene& scene, const Setting& setting) {
    const std::string text = setting.name + "=" + setting.value;
    if (is_knob(scene, setting.name))
        return scene::override_knob(scene, text);
    if (glsl::definition_of(scene, setting.name))
        return glsl::override_definition(scene, text);
    if (const auto number = number_at(scene, setting.name))
        if (replace(scene, replaced(*number, setting.value)))
            return {};
    return fail(no_such_name(scene, setting.name));
}

Result<scene::Scene> with(scene::Scene scene, const std::vector<Setting>& settings) {
    for (const Setting& setting : settings)
        TRY(apply(scene, setting));
    return scene;
}

std::string value_of(const scene::Scene& scene, std::string_view name) {
    const auto knob = std::ranges::find(scene.knobs, name, &scene::Knob::name);
    if (knob != scene.knobs.end())
        return scene::to_string(*knob);
    if (const auto defined = glsl::definition_of(scene, name))
        return *defined;
    const auto number = number_at(scene, name);
    return number ? number->word : std::string();
}

std::optional<scene::Scene> changed(scene::Scene scene, std::span<const glsl::Cure> changes) {
    if (!glsl::apply(scene.common, changes))
        return std::nullopt;
    for (scene::Pass& pass : scene.passes)
        if (!glsl::apply(pass.text, changes))
            return std::nullopt;
    return scene;
}

std::optional<std::vector<std::string>> compiled_words(const scene::Scene& scene) {
    std::vector<std::string> words;
    for (const scene::Pass& pass : scene.passes) {
        const auto text = glsl::ParsedText::read(glsl::assemble(scene, pass), {}, false);
        if (!text)
            return std::nullopt;
        for (const glsl::Word& word : (*text)->words())
            words.emplace_back(word.text);
    }
    return words;
}

} // namespace tidemark::lab
