// One look of WebAudio's AnalyserNode at a sound, at its defaults: a block of samples in, its magnitudes out;
// and magnitudes that were smoothed, with a wave, as the bytes that ShaderToy's inputs hold.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tidemark::sound {

inline constexpr int k_signal_width = 512;

/// A texture of 512 x 2: row 0 (the first 512 bytes) is the spectrum, row 1 the wave.
using SignalBytes = std::array<uint8_t, 2 * k_signal_width>;

inline constexpr int k_analysed_rate = 44100; ///< of the samples, a second
inline constexpr size_t k_block = 2048;       ///< samples

using Block = std::array<float, k_block>;
using Magnitudes = std::array<float, k_signal_width>;

/// Of the 512 lowest frequencies.
Magnitudes magnitudes_of(const Block& block);

/// Takes the next look into the mean of those before: 0.8 of it stays.
void smooth(Magnitudes& mean, const Magnitudes& next);

/// The wave is the oldest 512 samples of the block.
SignalBytes signal_bytes(const Magnitudes& mean, const Block& block);

} // namespace tidemark::sound
