// Reads sound files to floats in memory, and writes WAV files; the sound of channels.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::sound {

/// Longest sound that is read, in seconds.
inline constexpr int k_longest_sound = 20 * 60;

/// Interleaved samples, `channels` per frame, -1..1 for full scale, at the file's own rate.
struct SoundData {
    int rate = 44100;
    int channels = 2;
    std::vector<float> samples{};

    size_t frames() const { return channels > 0 ? samples.size() / size_t(channels) : 0; }
    double duration() const { return double(frames()) / double(rate); }
};

/// Loads libsndfile, as the first read_sound does: with its codecs it is ten shared objects, which a scene
/// without sound does not need. ErrorCode::load names the missing library or function.
Result<void> load_sound_library();

/// Decodes WAV, AIFF, FLAC, Ogg (Vorbis, Opus) and MP3. ErrorCode::load names the file and the fault.
Result<SoundData> read_sound(const std::filesystem::path& path);

/// Writes a WAV file of 16-bit stereo, left and right interleaved; a failure leaves no partial file
/// (ErrorCode::write).
Result<void> write_wav(const OutputPath& output, int rate, std::span<const int16_t> samples);

// Converts the picture that a Sound pass draws to samples.

/// Converts RGBA bytes (left low, left high, right low, right high) to interleaved 16-bit stereo: the number
/// -1 + 2 (low + 256 high) / 65535 times 32767, rounded to nearest, halves away from 0.
std::vector<int16_t> decode_sound_texels(std::span<const uint8_t> rgba);

// The sound of channels that read a sound file or a video, at the times of their textures: it starts again
// when the texture does.

/// The sound of a channel's file.
struct InputSound {
    SoundData data;
    double start = 0; ///< iChannelTime of the first sample, in seconds; may be negative
    double loop = 0;  ///< seconds of iTime after which the channel starts again
};

/// Reads a sound file (ErrorCode::load, as `read_sound`).
Result<InputSound> read_music(const std::filesystem::path& path);

/// Reads the first audio track of a video through ffmpeg; nothing if the video has none. Fails
/// (ErrorCode::load) as `image::VideoFrames::open`, and on tracks of more than `k_longest_sound` seconds.
Result<std::optional<InputSound>> read_video_sound(const std::filesystem::path& path);

/// Samples that ffmpeg's filter `ashowinfo` reports in a line.
struct ShownSamples {
    int64_t first = 0; ///< time of the first one by the file's clock, in samples
    int rate = 0;
    int channels = 0;
    size_t count = 0; ///< of each channel
};

/// Returns nothing for any other line. The filter `asettb=1/sr` must be before it.
std::optional<ShownSamples> ashowinfo_samples(std::string_view line);

/// The sound of a channel in 16-bit stereo at one rate, from iTime 0 on without an end.
class LoopedSound {
public:
    /// Converts the channels to two and the rate to `rate`; samples are unchanged if they have both already.
    LoopedSound(const InputSound& sound, int rate);

    /// Adds the samples of each side from sample `first` on to `mix`, left and right interleaved, 1 for each
    /// step of 16 bits. Sample n plays at iTime n / rate; before iTime 0 there is silence.
    void add(int64_t first, std::span<float> mix) const;

private:
    int64_t index_at(int64_t sample) const;

    std::vector<int16_t> samples_;
    int64_t start_; ///< sample of the loop at which `samples_` begin
    double loop_;   ///< in samples
};

/// Returns a mix in 16 bits. If it is the sum of `several` sounds, values up to three quarters of full scale
/// are unchanged and larger ones approach full scale; one sound alone is cut at full scale.
std::vector<int16_t> in_16_bits(std::span<const float> mix, bool several);

/// Returns the rate at which sounds of these rates are mixed: their own if they have the same one, from 8 to
/// 96 kHz; else 48 kHz.
int mixing_rate(std::span<const int> rates);

/// Returns `48 kHz stereo`, `44.1 kHz mono` or `48 kHz, 6 channels`.
std::string rate_words(int rate, int channels);

} // namespace tidemark::sound
