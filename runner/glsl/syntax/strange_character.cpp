#include "glsl/syntax/strange_character.hpp"

#include "base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace tidemark::glsl {
namespace {

struct Lookalike {
    int code;
    std::string_view glsl;
};

constexpr Lookalike k_lookalikes[] = {
    {0x00b7, "*"},  {0x00d7, "*"},  {0x00f7, "/"}, {0x2010, "-"}, {0x2011, "-"}, {0x2013, "-"},
    {0x2014, "-"},  {0x2044, "/"},  {0x2212, "-"}, {0x2215, "/"}, {0x2217, "*"}, {0x2260, "!="},
    {0x2264, "<="}, {0x2265, ">="}, {0xff08, "("}, {0xff09, ")"}, {0xff0b, "+"}, {0xff0c, ","},
    {0xff0d, "-"},  {0xff0e, "."},  {0xff1b, ";"}, {0xff1d, "="}, {0xff5b, "{"}, {0xff5d, "}"}};

/// Returns whether the character is a space of another width, a mark for writing direction or the byte-order
/// mark.
bool is_blank(int code) {
    return code == 0x85 || code == 0xa0 || code == 0xad || code == 0x1680 ||
           (code >= 0x2000 && code <= 0x200f) || (code >= 0x2028 && code <= 0x202f) ||
           (code >= 0x205f && code <= 0x2064) || code == 0x3000 || code == 0xfeff;
}

} // namespace

std::optional<StrangeCharacter> strange_character(std::string_view text) {
    const auto first = static_cast<unsigned char>(text.empty() ? 0 : text.front());
    if (first < 0x80 || (first & 0xc0u) == 0x80)
        return std::nullopt;
    const auto [length, code] = first_character(text);
    if (code < 0)
        return StrangeCharacter{fmt::format("a byte that is no UTF-8 (0x{:02x})", first), false, {}};
    const auto alike = std::ranges::find(k_lookalikes, code, &Lookalike::code);
    const std::string shown = is_blank(code) ? "a blank" : fmt::format("'{}'", text.substr(0, length));
    return StrangeCharacter{fmt::format("{} (U+{:04X})", shown, code), is_blank(code),
                            alike == std::end(k_lookalikes) ? std::string_view() : alike->glsl};
}

std::string advice_on(const StrangeCharacter& character) {
    return character.instead.empty() ? "names have letters a to z and A to Z, digits and _"
                                     : fmt::format("write {}", character.instead);
}

} // namespace tidemark::glsl
