// Steps of what the field itself proves to be free: safe whatever the knobs. What is proved by the field's value
// alone takes many steps, for it has to reckon with the steepest wave there could be. By value, slope along the
// ray and a bound of how it bends (M. Moinet, F. Neyret, Computer Graphics Forum 44(2), 2025, take second
// derivatives, too) the last steps are those of Newton's method from outside, which never passes the zero and
// doubles its digits with each.

vec2 march_clearance(float t);

const float k_close = 0.02; // of a pixel: what touches has no longer clearance, what only passes by has

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
        // Never shorter than what the ray's own rounding can tell from standing still.
        float taken = max(sampled.y, 1e-6 * t);
        if (sampled.x < march_touch(range, t) && taken < k_close * range.pixel * t) {
            return t + taken;
        }
        t += taken;
    }
    return march_exhausted(range, t, sampled.x);
}
