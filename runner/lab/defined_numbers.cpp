#include "lab/defined_numbers.hpp"

#include "glsl/overrides.hpp"
#include "text/tokens.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace tidemark::lab {

std::vector<DefinedNumber> defined_numbers(const scene::Scene& scene) {
    std::vector<DefinedNumber> numbers;
    for (const std::string& name : glsl::definition_names(scene)) {
        const std::string text = glsl::definition_of(scene, name).value_or("");
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc{} && end == text.data() + text.size())
            numbers.push_back({name, value, text.find_first_of(".eE") == text.npos});
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
                numbers.push_back({number, false});
        }
        close();
    };
    read(scene.common);
    for (const scene::Pass& pass : scene.passes)
        read(pass.text);
    return numbers;
}

bool speaks_of(std::string_view name, std::initializer_list<std::string_view> words) {
    std::string lower(name);
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return std::ranges::any_of(words, [&](std::string_view word) { return lower.find(word) != lower.npos; });
}

} // namespace tidemark::lab
