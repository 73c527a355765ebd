// The files of page/ as texts, embedded in the program by CMakeLists.txt.
#pragma once

#include <string_view>

namespace tidemark::report {

extern const std::string_view k_page;    ///< page.html
extern const std::string_view k_limits;  ///< limits.html
extern const std::string_view k_compare; ///< compare.html
extern const std::string_view k_style;   ///< style.css
extern const std::string_view k_copy;    ///< copy.js
extern const std::string_view k_explore; ///< the other scripts, concatenated

} // namespace tidemark::report
