// Suggests names after an unknown one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tidemark {

/// Returns "did you mean 'x'?" if one of `names` is close, else "it has x, y"; `none` if `names` is empty.
std::string hint_for(std::string_view name, const std::vector<std::string>& names, std::string_view none);

} // namespace tidemark
