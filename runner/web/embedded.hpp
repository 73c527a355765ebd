// The files from which a page is made, as texts compiled into the program (CMakeLists.txt).
#pragma once

#include <string_view>

namespace tidemark::web {

extern const std::string_view k_page;   ///< page.html
extern const std::string_view k_figure; ///< figure.html
extern const std::string_view k_style;  ///< style.css
extern const std::string_view k_host;   ///< host/*.js, joined

} // namespace tidemark::web

// The viewers' page as text: page/ and the shared files of web/host, joined by CMakeLists.txt and compiled
// into the program.

namespace tidemark::serve {

extern const std::string_view k_page;

} // namespace tidemark::serve
