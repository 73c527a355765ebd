// Splits a PNG file into its chunks. Neither interprets them nor verifies their checksums.
#pragma once

#include "image/byte_order.hpp"

#include <optional>
#include <string_view>

namespace tidemark::image {

inline constexpr size_t k_png_signature = 8;
inline constexpr size_t k_png_chunk_frame = 12; ///< bytes of a chunk's length, name and checksum

struct PngChunk {
    std::string_view whole; ///< from its length to its checksum, inclusive

    std::string_view name() const { return whole.substr(4, 4); }
    std::string_view data() const { return whole.substr(8, whole.size() - k_png_chunk_frame); }
    /// Returns the bytes that the checksum covers.
    std::string_view checked() const { return whole.substr(4, whole.size() - 8); }
    uint32_t checksum() const { return big_endian(whole, whole.size() - 4, 4); }
};

/// Takes the next chunk from the rest after the signature; returns nothing if it is incomplete.
inline std::optional<PngChunk> take_png_chunk(std::string_view& rest) {
    if (rest.size() < k_png_chunk_frame)
        return std::nullopt;
    const size_t length = big_endian(rest, 0, 4);
    if (length > rest.size() - k_png_chunk_frame)
        return std::nullopt;
    const PngChunk chunk{rest.substr(0, length + k_png_chunk_frame)};
    rest.remove_prefix(chunk.whole.size());
    return chunk;
}

} // namespace tidemark::image
