// Enhanced sphere tracing (B. Keinert, H. Schaefer, J. Korndoerfer, U. Ganse, M. Stamminger, STAG 2014): steps
// longer by `relaxation`; when the unbounding spheres before and after a step do not touch, there may be a
// surface between, so the step is taken back and the ray goes on without relaxation.

const float k_relaxation = 1.2; // 1..2; the more, the more steps are taken back

// Distance of the surface, -1: none.
float march(MarchRange range) {
    float relaxation = k_relaxation;
    float t = range.near;
    float before = 0.0;
    float taken = 0.0;
    float closest = range.near; // where the surface was least pixels away
    float closest_value = range.pixel * range.far;
    for (int i = 0; i < MAX_STEPS; ++i) {
        if (t > range.far) {
            return -1.0;
        }
        float value = march_sample(t);
        MARCH_FLAG(k_hit_negative, value < 0.0 && before - value > taken && i > 0);
        if (relaxation > 1.0 && before + abs(value) < taken) {
            t += before - taken;
            taken = before;
            relaxation = 1.0;
            continue;
        }
        if (value < march_touch(range, t)) {
            return t;
        }
        if (value * closest < closest_value * t) {
            closest = t;
            closest_value = value;
        }
        before = value;
        taken = relaxation * value;
        t += taken;
    }
    return march_exhausted(range, closest, closest_value);
}
