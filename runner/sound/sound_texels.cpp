#include "sound/sound_texels.hpp"

#include <cmath>

namespace tidemark::sound {

std::vector<int16_t> decode_sound_texels(std::span<const uint8_t> rgba) {
    std::vector<int16_t> samples(rgba.size() / 2);
    for (size_t i = 0; i < samples.size(); ++i) {
        const int packed = rgba[2 * i] + 256 * rgba[2 * i + 1];
        samples[i] = int16_t(std::lround(32767.0 * (-1.0 + 2.0 * packed / 65535.0)));
    }
    return samples;
}

} // namespace tidemark::sound
