// Sphere tracing with automatic relaxation (R. Ban, G. Valasek, Eurographics 2023): the field's slope along the
// ray, averaged over the steps so far, says how far the next step can go so that the spheres around both its
// ends just touch a plane of that slope. A step whose spheres do not touch is taken back, as in enhanced sphere
// tracing, and the average begins anew.

const float k_slope_memory = 0.3; // weight of the newest slope; the authors' value

// Distance of the surface, -1: none.
float march(MarchRange range) {
    float t = range.near;
    if (t > range.far) {
        return -1.0;
    }
    float value = march_sample(t);
    float slope = -1.0;
    for (int i = 1; i < MAX_STEPS; ++i) {
        if (value < march_touch(range, t)) {
            return t;
        }
        if (t > range.far) {
            return -1.0;
        }
        float taken = 2.0 * value / (1.0 - slope);
        float beyond = march_sample(t + taken);
        MARCH_FLAG(k_hit_negative, beyond < 0.0 && value - beyond > taken);
        if (taken > value + abs(beyond)) {
            slope = -1.0;
            continue;
        }
        slope += k_slope_memory * ((beyond - value) / taken - slope);
        t += taken;
        value = beyond;
    }
    return march_exhausted(range, t, value);
}
