// Helpers of the tests of directives: they read a text as a file of its own.
#pragma once

#include "scene/directives.hpp"

#include <string>
#include <string_view>

namespace tidemark::scene {

inline Result<Directives> read(std::string_view text, std::string_view file = "dir/a.glsl") {
    text::MappedText mapped;
    mapped.append(text, file, 1);
    return take_directives(mapped);
}

/// Returns the error message for `text`.
inline std::string refusal(std::string_view text) {
    const auto directives = read(text);
    return directives ? "it was read" : to_string(directives.error());
}

} // namespace tidemark::scene
