// The files of this folder that a page is made of, as texts: they lie in the program (CMakeLists.txt).
#pragma once

#include <string_view>

namespace tidemark::web {

extern const std::string_view k_page;   ///< page.html
extern const std::string_view k_figure; ///< figure.html
extern const std::string_view k_style;  ///< style.css
extern const std::string_view k_host;   ///< host/*.js, one behind the other

} // namespace tidemark::web
