// Steps of what the field itself proves to be free: safe whatever the knobs, and slow, for a proof has to
// reckon with the steepest wave there could be. Wants about eight times the MAX_STEPS of the others.

vec2 march_clearance(float t);

// Distance of the surface, -1: none.
float march(MarchRange range) {
    float t = range.near;
    vec2 sampled = vec2(0.0);
    for (int i = 0; i < MAX_STEPS; ++i) {
        if (t > range.far) {
            return -1.0;
        }
        sampled = march_clearance(t);
        march_count(sampled.x);
        if (sampled.x < march_touch(range, t)) {
            return t;
        }
        // Never shorter than what the ray's own rounding can tell from standing still.
        t += max(sampled.y, 1e-6 * t);
    }
    return march_exhausted(range, t, sampled.x);
}
