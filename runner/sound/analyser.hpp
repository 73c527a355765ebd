// One analysis step of WebAudio's AnalyserNode at its defaults: computes magnitudes from a block of samples,
// smooths them, and packs them with the wave as the bytes that ShaderToy's inputs hold.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tidemark::sound {

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

} // namespace tidemark::sound
