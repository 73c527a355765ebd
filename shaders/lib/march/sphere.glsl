// Sphere tracing (J. C. Hart, 1996) as ShaderToys have it: steps of the field's value until it is below
// HIT_DISTANCE, a length that knows nothing of pixels. Its error is of three kinds: a ray that passes close
// over a crest stops there, a ray whose steps run out counts as arrived wherever it is, and where the slope
// bound does not hold a step sinks in. With MARCH_PAST_FAR a ray that leaves the range is sampled once more
// before that is seen, as where the loop looks first and asks then.
#ifndef MARCH_PAST_FAR
#define MARCH_PAST_FAR 0
#endif

// Distance of the surface, -1: none.
float march(MarchRange range) {
    float t = range.near;
    for (int i = 0; i < MAX_STEPS && (MARCH_PAST_FAR == 1 || t <= range.far); ++i) {
        float value = march_sample(t);
        if (t > range.far) {
            return -1.0;
        }
        MARCH_FLAG(k_hit_negative, value < 0.0 && i > 0);
        if (value < HIT_DISTANCE) {
            return t;
        }
        t += value;
    }
    MARCH_FLAG(k_hit_exhausted, t <= range.far);
    return t <= range.far ? t : -1.0;
}
