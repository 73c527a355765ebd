#include "base/encoding.hpp"
#include "base/file.hpp"
#include "media/video_input.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace tidemark::image {
namespace {

using namespace std::string_view_literals;

class FileBytes {
public:
    explicit FileBytes(const std::filesystem::path& path)
        : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
        struct stat facts {};
        if (file_.get() >= 0 && ::fstat(file_.get(), &facts) == 0)
            size_ = uint64_t(facts.st_size);
    }
    uint64_t size() const { return size_; }
    /// Reads up to `count` bytes, fewer at the end.
    std::string at(uint64_t place, size_t count) const {
        std::string bytes(count, '\0');
        const ssize_t read = place < size_ ? ::pread(file_.get(), bytes.data(), count, off_t(place)) : 0;
        bytes.resize(size_t(std::max<ssize_t>(0, read)));
        return bytes;
    }

private:
    Descriptor file_;
    uint64_t size_ = 0;
};

/// MP4, MOV: checks that the file consists of complete boxes and, unless `wanted` is empty, one is of that
/// type.
bool has_all_boxes(const FileBytes& file, std::string_view wanted = {}) {
    constexpr size_t heading = 8;
    bool found = wanted.empty();
    for (uint64_t at = 0; at < file.size();) {
        const std::string box = file.at(at, 2 * heading);
        if (box.size() < heading)
            return false;
        found = found || std::string_view(box).substr(4, 4) == wanted;
        uint64_t size = big_endian(box, 0, 4);
        if (size == 0) // extends to the end
            return found;
        if (size == 1 && box.size() == 2 * heading)
            size = uint64_t{big_endian(box, 8, 4)} << 32 | big_endian(box, 12, 4);
        if (size < heading || size > file.size() - at)
            return false;
        at += size;
    }
    return found;
}

/// Reads the size of an EBML element and moves `place` past it; UINT64_MAX: unknown.
uint64_t ebml_size(std::string_view bytes, size_t& place) {
    const uint8_t first = place < bytes.size() ? uint8_t(bytes[place]) : 0;
    size_t length = 1;
    while (length <= 8 && (first & 0x80u >> (length - 1)) == 0)
        ++length;
    if (length > 8 || length > bytes.size() - place)
        return UINT64_MAX;
    uint64_t value = first & (0xffu >> length);
    for (size_t i = 1; i < length; ++i)
        value = value << 8 | uint8_t(bytes[place + i]);
    place += length;
    return value == (uint64_t{1} << 7 * length) - 1 ? UINT64_MAX : value;
}

/// WebM, Matroska: checks that the header and one segment are complete.
bool has_whole_segment(const FileBytes& file) {
    const std::string head = file.at(0, 256);
    size_t place = 4;
    const uint64_t header = ebml_size(head, place);
    if (header > head.size() - place)
        return true;
    place += header;
    if (!std::string_view(head).substr(place).starts_with("\x18\x53\x80\x67"sv))
        return true;
    place += 4;
    const uint64_t segment = ebml_size(head, place);
    return segment == UINT64_MAX || (place <= file.size() && segment <= file.size() - place);
}

/// Ogg: checks that the last page ends within the file and is marked as the last one.
bool has_last_page(const FileBytes& file) {
    constexpr uint64_t longest = 27 + 255 + 255 * 255;
    constexpr size_t heading = 27;
    const std::string tail = file.at(file.size() - std::min(file.size(), longest), longest);
    const size_t page = tail.rfind("OggS");
    if (page == tail.npos || tail.size() - page < heading)
        return false;
    const size_t segments = uint8_t(tail[page + 26]);
    if (tail.size() - page < heading + segments)
        return false;
    size_t size = heading + segments;
    for (size_t i = 0; i < segments; ++i)
        size += uint8_t(tail[page + heading + i]);
    constexpr uint8_t last = 4;
    return size <= tail.size() - page && (uint8_t(tail[page + 5]) & last) != 0;
}

/// GIF: checks the blocks up to the trailer.
class GifWalk {
public:
    explicit GifWalk(const FileBytes& file) : file_(file) {}

    bool reaches_end() {
        at_ = 10;
        skip_colours(2);
        while (at_ < file_.size())
            switch (take()) {
            case 0x3b: return true;
            case 0x21: // extension
                ++at_;
                skip_parts();
                break;
            case 0x2c: // picture
                at_ += 8;
                skip_colours(0);
                ++at_;
                skip_parts();
                break;
            case 0x00: break;
            default: return false;
            }
        return false;
    }

private:
    /// Reads a byte; 0 past the end.
    uint8_t take() {
        const std::string byte = file_.at(at_++, 1);
        return byte.empty() ? 0 : uint8_t(byte[0]);
    }
    /// Skips a colour table if the flags announce one, and `more` bytes before it.
    void skip_colours(uint64_t more) {
        const uint8_t flags = take();
        at_ += more + ((flags & 0x80u) != 0 ? uint64_t{3} << ((flags & 7u) + 1) : 0);
    }
    void skip_parts() {
        while (const uint8_t size = take())
            at_ += size;
    }

    const FileBytes& file_;
    uint64_t at_ = 0;
};

bool has_whole_riff(const FileBytes& file) {
    const uint64_t size = little_endian(file.at(0, 8), 4, 4);
    return size == 0 || size == UINT32_MAX || size <= file.size() - 8;
}

} // namespace

bool is_whole_video(const std::filesystem::path& path) {
    const FileBytes file(path);
    const std::string head = file.at(0, 12);
    const auto has = [&](size_t at, std::string_view what) {
        return at <= head.size() && std::string_view(head).substr(at).starts_with(what);
    };
    for (const std::string_view box : {"ftyp"sv, "moov"sv, "mdat"sv, "free"sv, "skip"sv, "wide"sv})
        if (has(4, box))
            return has_all_boxes(file);
    if (has(0, "\x1a\x45\xdf\xa3"sv))
        return has_whole_segment(file);
    if (has(0, "OggS"))
        return has_last_page(file);
    if (has(0, "GIF8"))
        return GifWalk(file).reaches_end();
    return !has(0, "RIFF") || !has(8, "AVI ") || has_whole_riff(file);
}

bool is_video_of(const std::filesystem::path& path, std::string_view muxer) {
    const FileBytes file(path);
    const std::string head = file.at(0, 12);
    if (muxer == "mp4" || muxer == "mov")
        return head.substr(std::min<size_t>(4, head.size())).starts_with("ftyp") &&
               has_all_boxes(file, "moov");
    const bool of_its_kind = muxer == "gif"    ? head.starts_with("GIF8")
                             : muxer == "webp" ? head.starts_with("RIFF") && head.ends_with("WEBP")
                                               : head.starts_with("\x1a\x45\xdf\xa3"sv);
    return of_its_kind && is_whole_video(path);
}

} // namespace tidemark::image
