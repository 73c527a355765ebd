// Characters beyond ASCII where code stands: GLSL has none, and what they were typed for is often plain.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::glsl {

struct StrangeCharacter {
    std::string name;         ///< `'−' (U+2212)`, `a byte that is no UTF-8 (0xff)`
    bool blank = false;       ///< looks like a blank, or like nothing
    std::string_view instead; ///< what to write; empty: not known
};

/// What `text` begins with; nothing where that is ASCII, or a byte in the middle of a character.
std::optional<StrangeCharacter> strange_character(std::string_view text);

/// What to do about one that is no blank, in words.
std::string advice_on(const StrangeCharacter& character);

} // namespace tidemark::glsl
