// The viewers' page as text: page/ and the shared files of web/host, joined by CMakeLists.txt and compiled
// into the program.
#pragma once

#include <string_view>

namespace tidemark::serve {

extern const std::string_view k_page;

} // namespace tidemark::serve
