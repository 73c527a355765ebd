// Fractional Brownian motion (B. Mandelbrot, J. van Ness, 1968) of value noise: octaves of it, each finer and
// lower than the last.
#ifndef LIB_FBM
#define LIB_FBM
#include "noise.glsl"

// 0..1, about 1/2. Slope <= 3/2 * sum (gain * lacunarity)^k / sum gain^k: without bound in the number of octaves
// when gain * lacunarity >= 1. Octaves are shifted so that no two have a lattice point in one place.
float fbm(vec2 position, int octaves, float gain, float lacunarity) {
    float sum = 0.0;
    float total = 0.0;
    float height = 1.0;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += height * value_noise(position, ivec2(0));
        total += height;
        height *= gain;
        position = lacunarity * position + vec2(17.3, 43.7);
    }
    return sum / total;
}
#endif
