// Segment tracing (E. Galin, E. Guerin, A. Paris, A. Peytavie, Computer Graphics Forum 39(2), 2020): a step as long
// as a bound of the field's slope allows that holds for the next stretch of the ray alone, not everywhere. Safe
// whatever the knobs. Wants about eight times the MAX_STEPS of the others.

vec2 march_fall(float t, float reach);

const float k_reach_growth = 1.5; // of the stretch that is looked at, over the last step; the authors' value

// Distance of the surface, -1: none.
float march(MarchRange range) {
    float t = range.near;
    float reach = max(range.far - t, 1e-6);
    vec2 sampled = vec2(0.0);
    for (int i = 0; i < MAX_STEPS; ++i) {
        if (t > range.far) {
            return -1.0;
        }
        sampled = march_fall(t, reach);
        march_count(sampled.x);
        if (sampled.x < march_touch(range, t)) {
            return t;
        }
        // Never shorter than what the ray's own rounding can tell from standing still.
        float taken = max(sampled.y * reach > sampled.x ? sampled.x / sampled.y : reach, 1e-6 * t);
        t += taken;
        reach = k_reach_growth * taken;
    }
    return march_exhausted(range, t, sampled.x);
}
