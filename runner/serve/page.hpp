// The page that viewers open, as a text: page/ and what web/host has for any page, put together by
// CMakeLists.txt. It lies in the program.
#pragma once

#include <string_view>

namespace tidemark::serve {

extern const std::string_view k_page;

} // namespace tidemark::serve
