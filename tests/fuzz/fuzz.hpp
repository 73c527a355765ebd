// Helpers of the fuzz targets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

/// Ends the process if the condition does not hold. Unlike assert it does so in every build.
#define REQUIRE(condition)                                                                                   \
    do {                                                                                                     \
        if (!(condition)) {                                                                                  \
            std::fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);                     \
            std::abort();                                                                                    \
        }                                                                                                    \
    } while (false)

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

inline std::string_view text_of(const uint8_t* data, size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// Cuts `text` at the first `separator`; the front comes back, the rest stays.
inline std::string_view cut(std::string_view& text, char separator) {
    const size_t end = text.find(separator);
    const std::string_view front = text.substr(0, end);
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    return front;
}
