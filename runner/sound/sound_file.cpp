#include "sound/sound_file.hpp"

#include "base/file.hpp"
#include "sound/sound_check.hpp"
#include "sound/sound_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

namespace tidemark::sound {
namespace {

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
        return refuse(fmt::format("it is damaged or no WAV, AIFF, FLAC, Ogg or MP3 sound ({})",
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

} // namespace tidemark::sound
