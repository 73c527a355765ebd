// What helps somebody who named what is not there.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tidemark {

/// "did you mean 'x'?" where one of `names` is near, else "it has x, y"; `none` where there are no names.
std::string hint_for(std::string_view name, const std::vector<std::string>& names, std::string_view none);

} // namespace tidemark
