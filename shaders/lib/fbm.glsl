// Fractional Brownian motion (B. Mandelbrot, J. van Ness, 1968) of value noise: octaves of it, each finer and
// lower than the last.
#ifndef LIB_FBM
#define LIB_FBM
#include "noise.glsl"
#include "phase.glsl"

// 0..1, about 1/2, drifting by `speed` a second. Slope <= 3/2 * sum (gain * lacunarity)^k / sum gain^k: without bound in
// the number of octaves when gain * lacunarity >= 1. Octaves are shifted so that no two have a lattice point in one
// place, and each drifts by whole cells and a fraction of its own: as fine after a month as at the start.
float fbm(vec2 position, vec2 speed, int octaves, float gain, float lacunarity) {
    float sum = 0.0;
    float total = 0.0;
    float height = 1.0;
    for (int octave = 0; octave < octaves; ++octave) {
        ivec2 cells;
        vec2 drift = vec2(split_product(speed.x, seconds(), cells.x), split_product(speed.y, seconds(), cells.y));
        sum += height * value_noise(position + drift, cells);
        total += height;
        height *= gain;
        position = lacunarity * position + vec2(17.3, 43.7);
        speed = rate_product(speed, vec2(lacunarity));
    }
    return sum / total;
}
#endif
