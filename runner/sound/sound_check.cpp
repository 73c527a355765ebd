#include "sound/sound_check.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tidemark::sound {
namespace {

uint8_t byte_at(std::string_view file, size_t at) {
    return uint8_t(file[at]);
}

enum class Order { little, big };

uint32_t word_at(std::string_view file, size_t at, Order order) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i)
        value = value << 8 | byte_at(file, at + (order == Order::big ? i : 3 - i));
    return value;
}

bool has(std::string_view file, size_t at, std::string_view what) {
    return at <= file.size() && file.substr(at).starts_with(what);
}

/// Checks the chunks of WAV and AIFF: a name, a size and that many bytes, padded to an even offset.
bool has_all_chunks(std::string_view file, Order order) {
    constexpr uint32_t unknown = 0x7fff0000; // this or more: written to a pipe
    constexpr size_t heading = 8;
    for (size_t at = 12; file.size() - at >= heading;) {
        const uint32_t size = word_at(file, at + 4, order);
        if (size >= unknown)
            return true;
        if (size > file.size() - at - heading)
            return false;
        at += std::min<size_t>(heading + size + size % 2, file.size() - at);
    }
    return true;
}

/// Checks the pages of an Ogg file; the last page of a stream has a flag.
bool has_all_pages(std::string_view file) {
    constexpr size_t heading = 27;
    constexpr uint8_t last = 4;
    bool ended = false;
    for (size_t at = 0; has(file, at, "OggS");) {
        if (file.size() - at < heading)
            return false;
        const size_t segments = byte_at(file, at + 26);
        if (file.size() - at < heading + segments)
            return false;
        size_t size = heading + segments;
        for (size_t i = 0; i < segments; ++i)
            size += byte_at(file, at + heading + i);
        if (size > file.size() - at)
            return false;
        ended = (byte_at(file, at + 5) & last) != 0;
        at += size;
    }
    return ended;
}

// --- MP3 -------------------------------------------------------------------------------------------

struct Mp3Frame {
    size_t bytes = 0;
    size_t side_bytes = 0; ///< between the header and the data
};

/// Reads a header of layer III of MPEG 1, 2 or 2.5; nothing if no frame of known length begins here.
std::optional<Mp3Frame> mp3_frame(std::string_view file, size_t at) {
    constexpr std::array<int, 16> rates_1 = {0,   32,  40,  48,  56,  64,  80,  96,
                                             112, 128, 160, 192, 224, 256, 320, 0};
    constexpr std::array<int, 16> rates_2 = {0, 8, 16, 24, 32, 40, 48, 56, 64, 80, 96, 112, 128, 144, 160, 0};
    constexpr std::array<int, 3> hertz = {44100, 48000, 32000};
    if (at > file.size() || file.size() - at < 4 || byte_at(file, at) != 0xff)
        return std::nullopt;
    const uint8_t kind = byte_at(file, at + 1), rates = byte_at(file, at + 2), mode = byte_at(file, at + 3);
    const int version = kind >> 3 & 3; // 3: MPEG 1, 2: MPEG 2, 0: MPEG 2.5
    const size_t rate = rates >> 2 & 3;
    if ((kind & 0xe6) != 0xe2 || version == 1 || rate == 3)
        return std::nullopt;
    const bool first = version == 3, mono = mode >> 6 == 3;
    const int bits = (first ? rates_1 : rates_2)[rates >> 4] * 1000;
    if (bits == 0)
        return std::nullopt;
    const int samples = hertz[rate] / (first ? 1 : version == 2 ? 2 : 4);
    return Mp3Frame{size_t((first ? 144 : 72) * bits / samples + (rates >> 1 & 1)),
                    first ? (mono ? 17u : 32u) : (mono ? 9u : 17u)};
}

/// Returns the offset after an ID3 tag.
size_t mp3_begin(std::string_view file) {
    if (!file.starts_with("ID3") || file.size() < 10)
        return 0;
    size_t size = 0;
    for (size_t i = 6; i < 10; ++i)
        size = size << 7 | (byte_at(file, i) & 0x7fu);
    return 10 + size;
}

/// Returns the number of frames that the first frame declares, which then holds no sound; 0: none declared.
uint32_t mp3_promise(std::string_view file, size_t at, const Mp3Frame& frame) {
    const size_t place = at + 4 + frame.side_bytes;
    if (!has(file, place, "Xing") && !has(file, place, "Info"))
        return 0;
    constexpr uint32_t tells_frames = 1;
    if (file.size() - place < 12 || (word_at(file, place + 4, Order::big) & tells_frames) == 0)
        return 0;
    return word_at(file, place + 8, Order::big);
}

bool has_all_mp3_frames(std::string_view file) {
    size_t at = mp3_begin(file);
    if (at > file.size())
        return false;
    auto frame = mp3_frame(file, at);
    const uint32_t promised = frame ? mp3_promise(file, at, *frame) : 0;
    uint32_t frames = 0;
    for (; frame; frame = mp3_frame(file, at), ++frames) {
        if (frame->bytes > file.size() - at)
            return false;
        at += frame->bytes;
    }
    return frames >= promised;
}

} // namespace

bool is_whole(std::string_view file) {
    if (file.starts_with("RIFF") && has(file, 8, "WAVE"))
        return has_all_chunks(file, Order::little);
    if (file.starts_with("FORM") && (has(file, 8, "AIFF") || has(file, 8, "AIFC")))
        return has_all_chunks(file, Order::big);
    if (file.starts_with("OggS"))
        return has_all_pages(file);
    if (file.starts_with("ID3") || mp3_frame(file, 0))
        return has_all_mp3_frames(file);
    return true;
}

std::optional<uint64_t> promised_frames(std::string_view file) {
    constexpr size_t place = 4 + 4 + 13; // of the lower 36 bits of five bytes in STREAMINFO
    if (!file.starts_with("fLaC") || file.size() < place + 5)
        return std::nullopt;
    const uint64_t frames =
        uint64_t(byte_at(file, place) & 0x0fu) << 32 | word_at(file, place + 1, Order::big);
    return frames > 0 ? std::optional(frames) : std::nullopt;
}

} // namespace tidemark::sound
