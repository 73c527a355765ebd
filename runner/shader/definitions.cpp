#include "shader/definitions.hpp"

#include "base/error.hpp"
#include "base/tokens.hpp"
#include "scene/scene.hpp"
#include "shader/token_reading.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

namespace tidemark::glsl {
namespace {

using text::Token;
using text::TokenKind;

/// A name with a value, and the place of the value.
struct Definition {
    size_t token; ///< the name's token
    std::string_view name;
    size_t begin;
    size_t end;
    bool separate;                   ///< the value is empty, so a blank must separate it from the name
    std::optional<size_t> keyword{}; ///< the token `const`
};

/// Reads the `#define` whose `#` is at `hash`; nothing for a macro with parameters.
std::optional<Definition> read_macro(const std::vector<Token>& tokens, size_t hash) {
    const size_t end = text::end_of_directive(tokens, hash);
    if (hash + 2 >= end || !tokens[hash + 1].is("define"))
        return std::nullopt;
    const Token& name = tokens[hash + 2];
    const bool has_value = hash + 3 < end;
    if (has_value && tokens[hash + 3].is("(") && tokens[hash + 3].glued)
        return std::nullopt;
    if (!has_value)
        return Definition{hash + 2, name.text, name.end(), name.end(), true};
    return Definition{hash + 2, name.text, tokens[hash + 3].begin, tokens[end - 1].end(), false};
}

/// Returns whether a declaration ends here at the latest, even if it is incomplete.
bool ends_declaration(const Token& token) {
    return token.is(";") || token.is("const") || (token.first_on_line && token.is("#"));
}

/// Reads the declarators of `const TYPE name = value, name = value;` after the token at `keyword`; returns
/// where they end.
size_t read_constants(const std::vector<Token>& tokens, size_t keyword, std::vector<Definition>& found) {
    size_t i = keyword + 1;
    while (i < tokens.size() && !ends_declaration(tokens[i])) {
        if (nesting(tokens[i].text) < 0) // `const` of a parameter
            break;
        if (!tokens[i].is("=")) {
            ++i;
            continue;
        }
        const Token& name = tokens[i - 1];
        size_t end = i + 1;
        for (int depth = 0; end < tokens.size(); ++end) {
            const Token& token = tokens[end];
            depth += nesting(token.text);
            if (depth < 0 || (depth == 0 && token.is(",")) || ends_declaration(token))
                break;
        }
        if (name.kind == TokenKind::identifier && end > i + 1)
            found.push_back({i - 1, name.text, tokens[i + 1].begin, tokens[end - 1].end(), false, keyword});
        i = end;
    }
    return i;
}

std::vector<Definition> find_definitions(const std::vector<Token>& tokens) {
    std::vector<Definition> found;
    for (size_t i = 0; i < tokens.size();) {
        if (tokens[i].first_on_line && tokens[i].is("#")) {
            if (const auto macro = read_macro(tokens, i))
                found.push_back(*macro);
            i = text::end_of_directive(tokens, i);
        } else if (tokens[i].is("const")) {
            i = read_constants(tokens, i, found);
        } else {
            ++i;
        }
    }
    return found;
}

Error no_such_definition(std::string_view name, const std::vector<std::string>& names) {
    return {ErrorCode::usage,
            fmt::format("the scene has no #define or const '{}': {}", name,
                        hint_for(name, names, "it defines none")),
            {}};
}

/// Returns all texts with author's code; Common comes first, as it does for the driver.
template <class AScene>
auto texts_of(AScene& scene) {
    std::vector<decltype(&scene.common)> texts{&scene.common};
    for (auto& pass : scene.passes)
        texts.push_back(&pass.text);
    return texts;
}

/// Returns the edits that set every definition of `name` to `value`; adds the other defined names to
/// `others`.
std::vector<text::Edit> edits_of(const std::vector<Token>& tokens, std::string_view name,
                                 std::string_view value, std::vector<std::string>& others) {
    std::vector<text::Edit> edits;
    for (const Definition& definition : find_definitions(tokens)) {
        if (definition.name == name)
            edits.push_back(
                {definition.begin, definition.end, (definition.separate ? " " : "") + std::string(value)});
        else if (std::find(others.begin(), others.end(), definition.name) == others.end())
            others.emplace_back(definition.name);
    }
    return edits;
}

constexpr int k_longest_name_chain = 32; ///< limit for names that stand for names, which may be cyclic

std::optional<std::string> value_of(const std::vector<NamedText>& definitions, std::string_view name) {
    const auto found = std::ranges::find(definitions, name, &NamedText::name);
    return found == definitions.end() ? std::nullopt : std::optional(found->text);
}

} // namespace

std::vector<std::string> definition_names(const scene::Scene& scene) {
    std::vector<std::string> names;
    for (const text::MappedText* mapped : texts_of(scene))
        for (const Definition& definition : find_definitions(text::tokenize(mapped->text())))
            if (std::find(names.begin(), names.end(), definition.name) == names.end())
                names.emplace_back(definition.name);
    return names;
}

std::vector<NamedText> definitions_of(const scene::Scene& scene) {
    std::vector<NamedText> found;
    std::unordered_set<std::string_view> names;
    for (const text::MappedText* mapped : texts_of(scene)) {
        const std::string& text = mapped->text();
        const auto tokens = text::tokenize(text);
        const Preprocessed preprocessed = preprocess(tokens);
        for (const Definition& definition : find_definitions(tokens))
            if (preprocessed.activity[definition.token] != Activity::inactive &&
                names.insert(definition.name).second)
                found.push_back({std::string(definition.name),
                                 text.substr(definition.begin, definition.end - definition.begin),
                                 mapped->lines().locate(tokens[definition.token].line).file});
    }
    return found;
}

std::vector<NamedText> plain_numbers(const scene::Scene& scene) {
    std::vector<NamedText> definitions = definitions_of(scene);
    std::erase_if(definitions, [](const NamedText& definition) {
        const auto tokens = text::tokenize(definition.text);
        const bool is_signed = !tokens.empty() && (tokens[0].is("-") || tokens[0].is("+"));
        return tokens.size() != size_t(is_signed) + 1 || tokens.back().kind != TokenKind::number;
    });
    return definitions;
}

std::optional<std::string> definition_of(const scene::Scene& scene, std::string_view name) {
    const std::vector<NamedText> definitions = definitions_of(scene);
    auto value = value_of(definitions, name);
    for (int i = 0; value && i < k_longest_name_chain; ++i) {
        auto meant = value_of(definitions, *value);
        if (!meant)
            break;
        value = std::move(meant);
    }
    return value;
}

Result<void> override_definition(scene::Scene& scene, std::string_view setting) {
    const auto split = TRY(scene::split_setting(setting, "--define"));
    const auto [name, value] = split;
    if (value.find_first_of("\n\r") != std::string_view::npos)
        return fail(ErrorCode::usage, fmt::format("--define {}: the value must be one line", name));
    std::vector<std::string> names;
    bool replaced = false;
    for (text::MappedText* mapped : texts_of(scene)) {
        const auto edits = edits_of(text::tokenize(mapped->text()), name, value, names);
        replaced = replaced || !edits.empty();
        mapped->apply(edits);
    }
    if (!replaced)
        return fail(no_such_definition(name, names));
    return {};
}

void define_by_variables(scene::Scene& scene, std::span<const scene::Setting> variables) {
    for (text::MappedText* mapped : texts_of(scene)) {
        const auto tokens = text::tokenize(mapped->text());
        std::vector<text::Edit> edits;
        std::optional<size_t> plain; // the last `const` removed: several names may share one
        for (const Definition& definition : find_definitions(tokens)) {
            const auto variable = std::ranges::find(variables, definition.name, &scene::Setting::name);
            if (variable == variables.end())
                continue;
            if (definition.keyword && definition.keyword != plain) {
                plain = definition.keyword;
                edits.push_back({tokens[*plain].begin, tokens[*plain].end(), ""});
            }
            edits.push_back(
                {definition.begin, definition.end, (definition.separate ? " " : "") + variable->value});
        }
        mapped->apply(edits);
    }
}

void override_definition(std::string& text, const scene::Setting& setting) {
    std::vector<std::string> others;
    auto edits = edits_of(text::tokenize(text), setting.name, setting.value, others);
    std::ranges::reverse(edits); // keeps the offsets of earlier edits valid
    for (const auto& edit : edits)
        text.replace(edit.begin, edit.end - edit.begin, edit.replacement);
}

} // namespace tidemark::glsl
