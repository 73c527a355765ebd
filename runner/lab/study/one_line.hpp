// Cleans texts from a scene or a study file for files that other programs read line by line.
#pragma once

#include <string>
#include <string_view>

namespace tidemark::lab {

/// Returns the text with each control character, including line breaks, replaced by a blank. Other bytes
/// stay.
inline std::string one_line(std::string_view text) {
    std::string plain(text);
    for (char& c : plain)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
            c = ' ';
    return plain;
}

} // namespace tidemark::lab
