// Lines about what comes from outside, which may come a thousand times a second: each is said once, and not
// too many.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace tidemark::cli {

class SaidOnce {
public:
    void say(std::string_view line);

private:
    static constexpr size_t k_most_lines = 32;
    static constexpr size_t k_longest = 300; ///< bytes

    std::set<std::string, std::less<>> said_;
};

} // namespace tidemark::cli
