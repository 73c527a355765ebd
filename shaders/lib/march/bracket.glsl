// Sphere tracing with automatic relaxation that looks for a change of sign instead of a small value. Near the
// surface a step aims beyond the zero that the last two samples point to: below the surface, the zero lies
// between two samples and is interpolated; above it, the ray has passed a crest by and goes on. So nothing
// stops short on a crest that it only comes near, no value is too small to tell from noise, and the slow end
// of sphere tracing, where each step is a part of the last, is replaced by interpolation.
//
// A step whose unbounding spheres leave a gap is taken back, as in enhanced sphere tracing, but for gaps of
// less than k_gap of a pixel: what is thinner than that along the ray may be missed.
#include "interpolate.glsl"

const float k_slope_memory = 0.3; // weight of the newest slope along the ray
const float k_gap = 0.05;         // of a pixel's width
const float k_reach = 0.05;       // a zero expected within this and a pixel is aimed at, world units
const float k_overshoot = 1.2;    // by this much of its distance

// Distance of the surface, -1: none.
float march(MarchRange range) {
    float t = range.near;
    if (t > range.far) {
        return -1.0;
    }
    float value = march_sample(t);
    if (value < 0.0) {
        return t;
    }
    float ahead = t;
    float beyond = value;
    float slope = -1.0;
    float wish = value;
    for (int i = 1; i < MAX_STEPS && t < range.far; ++i) {
        ahead = min(t + wish, range.far);
        float taken = ahead - t;
        beyond = march_sample(ahead);
        float pixel = range.pixel * ahead;
        if (beyond < 0.0) {
            MARCH_FLAG(k_hit_negative, value - beyond > taken);
            break;
        }
        if (taken > value + beyond + k_gap * pixel) {
            wish = value;
            slope = -1.0;
            continue;
        }
        float seen = (beyond - value) / taken;
        slope += k_slope_memory * (seen - slope);
        t = ahead;
        value = beyond;
        wish = max(2.0 * value / (1.0 - slope), k_gap * pixel);
        // Where the slope of the last step leads to zero: nowhere, if it rose.
        float zero = value / max(-seen, 1e-3);
        if (zero < k_reach + pixel) {
            wish = max(wish, k_overshoot * zero);
        }
    }
    // After the loop, so that pixels which are drawn together interpolate together.
    if (beyond < 0.0) {
        return march_interpolate(range, t, value, ahead, beyond);
    }
    return t < range.far ? march_exhausted(range, t, value) : -1.0;
}
