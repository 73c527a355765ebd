// Non-ASCII characters in code, which GLSL does not have; suggests the ASCII character that was probably
// meant.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::glsl {

struct StrangeCharacter {
    std::string name;         ///< name for messages: `'−' (U+2212)`, `a byte that is no UTF-8 (0xff)`
    bool blank = false;       ///< looks like a blank, or is invisible
    std::string_view instead; ///< suggested replacement; empty if there is none
};

/// Describes the first character of `text`. Returns nothing for ASCII, and for a byte in the middle of a
/// character.
std::optional<StrangeCharacter> strange_character(std::string_view text);

/// Returns advice for a message about a character that is not blank.
std::string advice_on(const StrangeCharacter& character);

} // namespace tidemark::glsl
