#include "image/files/video_note.hpp"

#include "base/hash.hpp"
#include "image/byte_order.hpp"

#include <span>

namespace tidemark::image {
namespace {

// ISO/IEC 14496-12, 8.1.2: a box begins with its size and its type; players skip `free`. Ours contains the
// note, the checksum of all bytes before it, and the size of the box again, so that it can be found from the
// end.
constexpr std::string_view k_type = "free";
constexpr size_t k_checksum = 64;
constexpr size_t k_frame = 4 + k_type.size() + k_checksum + 4;

std::string bytes_of(size_t size) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes += char(size >> shift & 0xff);
    return bytes;
}

std::string checksum_of(std::string_view video, std::string_view box) {
    Sha256 hash;
    hash.add(std::as_bytes(std::span(video)));
    hash.add(std::as_bytes(std::span(box)));
    return hash.digits();
}

} // namespace

std::string note_box(std::string_view video, std::string_view note) {
    const std::string size = bytes_of(note.size() + k_frame);
    std::string box = size;
    box.append(k_type).append(note);
    return box.append(checksum_of(video, box)).append(size);
}

std::optional<std::string> note_at_end(std::string_view file) {
    if (file.size() < k_frame)
        return std::nullopt;
    const size_t size = big_endian(file, file.size() - 4, 4);
    if (size < k_frame || size > file.size())
        return std::nullopt;
    const std::string_view video = file.substr(0, file.size() - size);
    const size_t header = 4 + k_type.size();
    const std::string_view note = file.substr(video.size() + header, size - k_frame);
    if (file.substr(video.size()) != note_box(video, note))
        return std::nullopt;
    return std::string(note);
}

} // namespace tidemark::image
