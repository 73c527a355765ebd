// Converts the picture that a Sound pass draws to samples.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tidemark::sound {

/// Converts RGBA bytes (left low, left high, right low, right high) to interleaved 16-bit stereo: the number
/// -1 + 2 (low + 256 high) / 65535 times 32767, rounded to nearest, halves away from 0.
std::vector<int16_t> decode_sound_texels(std::span<const uint8_t> rgba);

} // namespace tidemark::sound
