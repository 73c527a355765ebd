// Reads sound files to floats in memory, and writes WAV files.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
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

/// Decodes WAV, AIFF, FLAC, Ogg (Vorbis, Opus) and MP3. ErrorCode::load names the file and the fault.
Result<SoundData> read_sound(const std::filesystem::path& path);

/// Writes a WAV file of 16-bit stereo, left and right interleaved; a failure leaves no partial file
/// (ErrorCode::write).
Result<void> write_wav(const OutputPath& output, int rate, std::span<const int16_t> samples);

// Converts the picture that a Sound pass draws to samples.

/// Converts RGBA bytes (left low, left high, right low, right high) to interleaved 16-bit stereo: the number
/// -1 + 2 (low + 256 high) / 65535 times 32767, rounded to nearest, halves away from 0.
std::vector<int16_t> decode_sound_texels(std::span<const uint8_t> rgba);

} // namespace tidemark::sound
