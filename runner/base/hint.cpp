#include "base/hint.hpp"

#include "base/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tidemark {

std::string hint_for(std::string_view name, const std::vector<std::string>& names, std::string_view none) {
    if (names.empty())
        return std::string(none);
    const std::string nearest = nearest_name(name, names);
    return nearest.empty() ? fmt::format("it has {}", fmt::join(names, ", "))
                           : fmt::format("did you mean '{}'?", nearest);
}

} // namespace tidemark
