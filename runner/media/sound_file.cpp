#include "media/sound_file.hpp"

#include "base/dynamic_library.hpp"
#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"

#include <fmt/format.h>
#include <sndfile.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace tidemark::sound {

// Checks that a sound file is complete, because libsndfile plays the rest of a truncated file without an
// error. Handles WAV, AIFF, FLAC, Ogg and MP3. Decodes nothing.

namespace {

uint8_t byte_at(std::string_view file, size_t at) {
    return uint8_t(file[at]);
}

enum class Order { little, big };

bool has(std::string_view file, size_t at, std::string_view what) {
    return at <= file.size() && file.substr(at).starts_with(what);
}

/// Checks the chunks of WAV and AIFF: a name, a size and that many bytes, padded to an even offset.
bool has_all_chunks(std::string_view file, Order order) {
    constexpr uint32_t unknown = 0x7fff0000; // this or more: written to a pipe
    constexpr size_t heading = 8;
    for (size_t at = 12; file.size() - at >= heading;) {
        const uint32_t size =
            order == Order::big ? big_endian(file, at + 4, 4) : little_endian(file, at + 4, 4);
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
    if (file.size() - place < 12 || (big_endian(file, place + 4, 4) & tells_frames) == 0)
        return 0;
    return big_endian(file, place + 8, 4);
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

/// Returns false if parts that the file declares lie beyond its end. Returns true for unknown formats and for
/// streams whose writer did not know their length.
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

/// Returns the length in a FLAC's header; nothing for other formats or if the header has none.
std::optional<uint64_t> promised_frames(std::string_view file) {
    constexpr size_t place = 4 + 4 + 13; // of the lower 36 bits of five bytes in STREAMINFO
    if (!file.starts_with("fLaC") || file.size() < place + 5)
        return std::nullopt;
    const uint64_t frames = uint64_t(byte_at(file, place) & 0x0fu) << 32 | big_endian(file, place + 1, 4);
    return frames > 0 ? std::optional(frames) : std::nullopt;
}

namespace {

/// The functions of libsndfile in use.
struct SoundLibrary {
    decltype(&sf_open_virtual) open_virtual = nullptr;
    decltype(&sf_readf_float) read_frames = nullptr;
    decltype(&sf_strerror) message = nullptr;
    decltype(&sf_close) close = nullptr;
};

Result<SoundLibrary> load_sndfile() {
    SoundLibrary functions;
    SharedLibrary library("libsndfile.so.1");
    library.find("sf_open_virtual", functions.open_virtual)
        .find("sf_readf_float", functions.read_frames)
        .find("sf_strerror", functions.message)
        .find("sf_close", functions.close);
    TRY(library.complete("libsndfile, which reads sound", "libsndfile1"));
    return functions;
}

/// Returns the library, loaded by the first call; other threads wait for it. It stays until the process ends.
const Result<SoundLibrary>& sound_library() {
    static const Result<SoundLibrary> library = load_sndfile();
    return library;
}

constexpr int k_most_channels = 8;
constexpr int k_least_rate = 1000;
constexpr int k_most_rate = 384000;
constexpr size_t k_largest_sound_file = size_t{1} << 30;

/// A file in memory, with the interface that libsndfile reads through.
struct MemoryFile {
    std::string_view bytes;
    sf_count_t place = 0;
};

sf_count_t length_of(void* user) {
    return sf_count_t(static_cast<MemoryFile*>(user)->bytes.size());
}

sf_count_t seek(sf_count_t offset, int whence, void* user) {
    auto& file = *static_cast<MemoryFile*>(user);
    const sf_count_t size = length_of(user);
    const sf_count_t base = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? file.place : size;
    if (offset < -base || offset > size - base)
        return -1;
    return file.place = base + offset;
}

sf_count_t read(void* to, sf_count_t count, void* user) {
    auto& file = *static_cast<MemoryFile*>(user);
    const sf_count_t taken =
        std::clamp<sf_count_t>(length_of(user) - file.place, 0, std::max<sf_count_t>(count, 0));
    std::memcpy(to, file.bytes.data() + file.place, size_t(taken));
    file.place += taken;
    return taken;
}

sf_count_t no_write(const void*, sf_count_t, void*) {
    return 0;
}

sf_count_t tell(void* user) {
    return static_cast<MemoryFile*>(user)->place;
}

/// Reads to the end of the data: the number of frames in a header may be wrong, and for MP3 it is a guess.
std::vector<float> decoded(const SoundLibrary& library, SNDFILE* file, const SF_INFO& info) {
    constexpr size_t block = 1 << 14;
    const auto channels = size_t(info.channels);
    const size_t most = size_t(info.samplerate) * size_t{k_longest_sound} * channels;
    std::vector<float> samples;
    for (;;) {
        const size_t before = samples.size();
        samples.resize(before + block * channels);
        const sf_count_t frames = library.read_frames(file, samples.data() + before, sf_count_t(block));
        samples.resize(before + size_t(std::max<sf_count_t>(frames, 0)) * channels);
        if (frames <= 0 || samples.size() > most)
            return samples;
    }
}

void append(std::string& text, uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i)
        text += char(value >> (8 * i) & 0xffu);
}

/// Returns the 44 bytes of RIFF, "fmt " and "data".
std::string wav_header(int rate, uint32_t data_bytes) {
    constexpr uint32_t pcm = 1, channels = 2, bits = 16, frame_bytes = channels * bits / 8;
    std::string header = "RIFF";
    append(header, 36 + data_bytes, 4);
    header += "WAVEfmt ";
    append(header, 16, 4);
    append(header, pcm, 2);
    append(header, channels, 2);
    append(header, uint32_t(rate), 4);
    append(header, uint32_t(rate) * frame_bytes, 4);
    append(header, frame_bytes, 2);
    append(header, bits, 2);
    header += "data";
    append(header, data_bytes, 4);
    return header;
}

} // namespace

Result<void> load_sound_library() {
    return sound_library().map([](const SoundLibrary&) {});
}

Result<SoundData> read_sound(const std::filesystem::path& path) {
    const auto refuse = [&](std::string_view why) {
        return fail(ErrorCode::load, fmt::format("cannot read '{}': {}", path.string(), why));
    };
    const Result<std::string> bytes = read_file(path, k_largest_sound_file);
    if (!bytes)
        return fail(bytes.error());
    if (bytes->empty())
        return refuse("the file is empty");
    const Result<SoundLibrary>& library = sound_library();
    if (!library)
        return fail(library.error());
    constexpr std::string_view cut_short = "the file is damaged or cut short";
    if (!is_whole(*bytes))
        return refuse(cut_short);
    MemoryFile memory{*bytes};
    SF_VIRTUAL_IO calls{length_of, seek, read, no_write, tell};
    SF_INFO info{};
    const std::unique_ptr<SNDFILE, decltype(&sf_close)> file(
        library->open_virtual(&calls, SFM_READ, &info, &memory), library->close);
    if (!file)
        return refuse(fmt::format("it is damaged, or not a WAV, AIFF, FLAC, Ogg or MP3 sound ({})",
                                  library->message(nullptr)));
    if (info.channels < 1 || info.channels > k_most_channels)
        return refuse(fmt::format("it has {} channels; the limit is {}", info.channels, k_most_channels));
    if (info.samplerate < k_least_rate || info.samplerate > k_most_rate)
        return refuse(fmt::format("its rate is {} Hz; rates from {} to {} are read", info.samplerate,
                                  k_least_rate, k_most_rate));
    SoundData sound{info.samplerate, info.channels, decoded(*library, file.get(), info)};
    if (sound.samples.empty())
        return refuse("there is no sound in it, or it is damaged");
    if (sound.frames() > size_t(sound.rate) * size_t{k_longest_sound})
        return refuse(fmt::format("it is longer than {} minutes", k_longest_sound / 60));
    if (sound.frames() < promised_frames(*bytes).value_or(0))
        return refuse(cut_short);
    return sound;
}

Result<void> write_wav(const OutputPath& output, int rate, std::span<const int16_t> samples) {
    static_assert(std::endian::native == std::endian::little);
    assert(rate > 0 && samples.size() % 2 == 0);
    if (samples.size_bytes() > std::numeric_limits<uint32_t>::max() - 36)
        return fail(ErrorCode::write,
                    fmt::format("cannot write '{}': a WAV file holds 4 GiB at most; write a shorter sound",
                                output.string()));
    std::string file = wav_header(rate, uint32_t(samples.size_bytes()));
    file.append(reinterpret_cast<const char*>(samples.data()), samples.size_bytes());
    return write_file(output, file);
}

std::vector<int16_t> decode_sound_texels(std::span<const uint8_t> rgba) {
    std::vector<int16_t> samples(rgba.size() / 2);
    for (size_t i = 0; i < samples.size(); ++i) {
        const int packed = rgba[2 * i] + 256 * rgba[2 * i + 1];
        samples[i] = int16_t(std::lround(32767.0 * (-1.0 + 2.0 * packed / 65535.0)));
    }
    return samples;
}

} // namespace tidemark::sound
