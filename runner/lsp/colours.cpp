#include "lsp/colours.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::lsp {
namespace {

/// Returns begin and end (offsets) of the default in a knob's line: after the `=`, through the first `)` or
/// the last token. Returns nothing without a default.
std::optional<std::pair<size_t, size_t>> default_of(const Symbol& symbol, std::string_view text) {
    const std::string_view line = text.substr(symbol.begin, symbol.end - symbol.begin);
    const auto tokens = text::tokenize(line);
    const auto equals = std::ranges::find_if(tokens, [](const text::Token& token) { return token.is("="); });
    if (equals == tokens.end() || equals + 1 == tokens.end())
        return std::nullopt;
    const auto close =
        std::find_if(equals, tokens.end(), [](const text::Token& token) { return token.is(")"); });
    const auto last = close == tokens.end() ? tokens.end() - 1 : close;
    return std::pair(symbol.begin + (equals + 1)->begin, symbol.begin + last->end());
}

Json colour_of(const scene::KnobValue& value) {
    const auto part = [](double number) { return std::clamp(number, 0.0, 1.0); };
    return {{"red", part(value[0])}, {"green", part(value[1])}, {"blue", part(value[2])}, {"alpha", 1}};
}

/// Rounds to three decimals, which is finer than a byte's 255 steps.
double rounded(const Json& number) {
    return std::round(number.get<double>() * 1000) / 1000;
}

} // namespace

Json document_colours(const Workspace& workspace, Encoding encoding) {
    Json colours = Json::array();
    const SourceFile& file = workspace.files.front();
    const Lines lines(file.text, encoding);
    for (const Symbol& symbol : file.symbols) {
        const scene::Knob* knob = symbol.kind == Symbol::Kind::knob ? workspace.knob(symbol.name) : nullptr;
        if (!knob || knob->type != scene::KnobType::color3)
            continue;
        if (const auto range = default_of(symbol, file.text))
            colours.push_back(
                {{"range", lines.range(range->first, range->second)}, {"color", colour_of(knob->initial)}});
    }
    return colours;
}

Json colour_presentations(const Json& colour, const Json& range) {
    const scene::Knob knob{
        .name = {},
        .type = scene::KnobType::color3,
        .value = {rounded(colour.at("red")), rounded(colour.at("green")), rounded(colour.at("blue")), 0}};
    const std::string literal = scene::to_literal(knob);
    return Json::array({{{"label", literal}, {"textEdit", {{"range", range}, {"newText", literal}}}}});
}

} // namespace tidemark::lsp
