// Clouds as a sum of OCTAVES of value noise, each half as high and twice as fine (B. Mandelbrot's fractional
// Brownian motion). What each octave costs and what leaving it out is worth: fbm_octaves.study.json.
#define OCTAVES 6

float lattice(ivec2 p) {
    uint n = uint(p.x) * 3242174889u + uint(p.y) * 2447445413u;
    n = (n ^ (n >> 15)) * 0xb995450du;
    return float(n >> 8) / 16777216.0;
}

float value_noise(vec2 p) {
    ivec2 cell = ivec2(floor(p));
    vec2 s = fract(p);
    s *= s * (3.0 - 2.0 * s);
    return mix(mix(lattice(cell), lattice(cell + ivec2(1, 0)), s.x),
               mix(lattice(cell + ivec2(0, 1)), lattice(cell + ivec2(1, 1)), s.x), s.y);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = 4.0 * fragCoord / iResolution.y + vec2(0.2 * iTime, 0.0);
    float sum = 0.0;
    float height = 0.5;
    for (int i = 0; i < OCTAVES; ++i) {
        sum += height * (value_noise(p) - 0.5);
        height *= 0.5;
        p = 2.0 * mat2(0.8, -0.6, 0.6, 0.8) * p;
    }
    fragColor = vec4(mix(vec3(0.25, 0.45, 0.75), vec3(1.0), smoothstep(-0.2, 0.35, sum)), 1.0);
}
