// Constants that are none in a promoted text: a call of a function that is not GLSL's own is no constant
// expression.
#pragma once

#include "glsl/syntax/reading.hpp"

#include <functional>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Each `const` of a declaration whose value calls, through macros and other constants too, a function that
/// `replaced` names; as indices of tokens.
std::vector<size_t> find_lost_constants(const Reading& reading,
                                        const std::function<bool(std::string_view)>& replaced);

} // namespace tidemark::glsl
