#include "glsl/cure/loop_turns.hpp"

#include "glsl/syntax/number.hpp"

#include <fmt/format.h>

#include <utility>

namespace tidemark::glsl {
namespace {

/// Writes the value with the type of the digits that it replaces.
std::string number_like(std::string_view digits, double value) {
    std::string text = fmt::format("{}", value);
    if (digits.find_first_of(".eE") != digits.npos)
        return as_float(text);
    return digits.ends_with('u') ? text + "u" : text;
}

} // namespace

std::optional<Wrap> with_turns(const ParsedText& text, const LoopBound& bound, double turns) {
    const auto written =
        bound.number == k_no_node ? std::nullopt : written_for(text, bound.number, bound.number);
    if (!written)
        return std::nullopt;
    return in_place_of(text, *written, number_like(text.word_of(bound.number), bound.first + turns));
}

} // namespace tidemark::glsl
