// Prints messages about live inputs, which may repeat a thousand times a second: each once, and at most 32.
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
    static constexpr size_t k_longest = 300; ///< bytes; the rest of a message is cut off

    std::set<std::string, std::less<>> said_;
};

} // namespace tidemark::cli
