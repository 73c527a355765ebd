// Reads integers of several bytes from a file's bytes. Does not check bounds.
#pragma once

#include <cstdint>
#include <string_view>

namespace tidemark::image {

inline uint32_t big_endian(std::string_view file, size_t at, size_t bytes) {
    uint32_t value = 0;
    for (size_t i = 0; i < bytes; ++i)
        value = value << 8 | uint8_t(file[at + i]);
    return value;
}

inline uint32_t little_endian(std::string_view file, size_t at, size_t bytes) {
    uint32_t value = 0;
    for (size_t i = bytes; i-- > 0;)
        value = value << 8 | uint8_t(file[at + i]);
    return value;
}

} // namespace tidemark::image
