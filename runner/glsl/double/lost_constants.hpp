// Finds constants that a promoted text must declare without `const`: a call of a function that is not GLSL's
// own is not a constant expression.
#pragma once

#include "glsl/syntax/reading.hpp"

#include <functional>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Returns the token of each `const` in a declaration whose value calls a function that `replaced` accepts,
/// directly or through macros and other constants.
std::vector<size_t> find_lost_constants(const Reading& reading,
                                        const std::function<bool(std::string_view)>& replaced);

} // namespace tidemark::glsl
