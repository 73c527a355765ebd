// Samples at equal distances, then interpolation where the sign changes: for comparison. A wave thinner along
// the ray than FIXED_STEP may be missed, however far the others are from zero.
#include "interpolate.glsl"

// Distance of the surface, -1: none.
float march(MarchRange range) {
    float t = range.near;
    float value = 0.0;
    for (int i = 0; i < MAX_STEPS && t <= range.far; ++i) {
        float beyond = march_sample(t);
        if (beyond < 0.0) {
            return i == 0 ? t : march_interpolate(range, t - FIXED_STEP, value, t, beyond);
        }
        value = beyond;
        t += FIXED_STEP;
    }
    MARCH_FLAG(k_hit_exhausted, t <= range.far);
    return -1.0;
}
