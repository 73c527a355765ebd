// Sound analysis for music inputs: Fourier transform, sample rates, ShaderToy's bytes.
//
// The discrete Fourier transform. Forty lines of our own: only one size is needed, at most 128 times a frame
// for each sound, and the resulting bytes must not depend on a library's choice of algorithm.
#pragma once

#include "media/sound_file.hpp"

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace tidemark::sound {

/// Replaces x by X[k] = sum of x[n] exp(-2 pi i n k / N), not scaled. N is a power of two.
void transform(std::span<std::complex<double>> x);

// Converts one channel to another sample rate.

/// Returns the samples, band-limited by a sinc with 32 crossings at the lower rate under a Blackman window.
/// Sample n is at the time n / to_rate; outside of `samples` there is silence. Returns the same samples if
/// the rates are equal.
std::vector<float> resampled(std::span<const float> samples, int from_rate, int to_rate);

// One analysis step of WebAudio's AnalyserNode at its defaults: computes magnitudes from a block of samples,
// smooths them, and packs them with the wave as the bytes that ShaderToy's inputs hold.

inline constexpr int k_signal_width = 512;

/// Texture of 512 x 2: row 0 (the first 512 bytes) is the spectrum, row 1 the wave.
using SignalBytes = std::array<uint8_t, 2 * k_signal_width>;

inline constexpr int k_analysed_rate = 44100; ///< samples per second
inline constexpr size_t k_block = 2048;       ///< samples

using Block = std::array<float, k_block>;
using Magnitudes = std::array<float, k_signal_width>;

/// Returns the magnitudes of the 512 lowest frequencies.
Magnitudes magnitudes_of(const Block& block);

/// Adds the next magnitudes to the running mean, which keeps a weight of 0.8.
void smooth(Magnitudes& mean, const Magnitudes& next);

/// Returns the bytes; the wave is the oldest 512 samples of the block.
SignalBytes signal_bytes(const Magnitudes& mean, const Block& block);

// Computes the bytes of ShaderToy's music inputs at a time: 512 of spectrum and 512 of wave.

/// Returns the signal that ShaderToy's site uses when there is no sound, at `iTime` = `time`. (iChannelTime
/// is then 10 + iTime.)
SignalBytes silent_signal(double time);

/// A sound as WebAudio's AnalyserNode at its defaults shows it in a context of 44100 Hz: mixed down to mono,
/// blocks of 2048 samples under a Blackman window (alpha 0.16), 512 of the 1024 magnitudes (21.5 Hz each),
/// smoothed with 0.8, -100..-30 dB as 0..255; the wave is the oldest 512 samples of the block, 128 (1 + x). A
/// browser smooths from call to call. Here each call counts as sixty calls per second since the start of the
/// sound, at whole multiples of 1/60 s, of which the last 128 count (0.8^128 is -248 dB): the bytes depend
/// only on the sound and the time. The wave is that of the exact time.
class Spectrum {
public:
    explicit Spectrum(const SoundData& sound);

    double duration() const { return duration_; }

    /// Returns the bytes at `time`, in seconds from the start of the sound; before the start and after the
    /// end there is silence.
    SignalBytes at(double time);

private:
    Block block_before(int64_t end) const;
    void step_to(int64_t step);

    double duration_ = 0.0;
    std::vector<float> mono_; ///< at 44100 Hz
    std::deque<Magnitudes> recent_;
    int64_t newest_ = -1; ///< the step of recent_.back()
};

} // namespace tidemark::sound
