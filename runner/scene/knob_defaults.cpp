#include "scene/knob_defaults.hpp"

#include "text/tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace tidemark::scene {
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
            return fail(ErrorCode::write, fmt::format("no line '#iUniform … {}' is in it", knob.name));
        changed.replace(place->begin, place->end - place->begin, " = " + to_literal(knob));
    }
    return changed;
}

} // namespace tidemark::scene
