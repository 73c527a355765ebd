// The zero between two samples of different sign: regula falsi with the weights of N. Anderson and
// A. Bjoerck (1973), which does not stick to one end where the field bends or folds; order 1.7.

const int k_interpolations = 4;

// 0 <= value_before at `before`, value_beyond < 0 at `beyond`. Ends when a sample is nearer to zero than
// 1/300 of a pixel is wide. Always between the two.
float march_interpolate(MarchRange range, float before, float value_before, float beyond, float value_beyond) {
    value_before = max(value_before, range.noise); // never 0 - 0 below
    float t = before + (beyond - before) * (value_before / (value_before - value_beyond));
    for (int i = 0; i < k_interpolations; ++i) {
        float value = march_sample(t);
        if (value < 0.0) {
            value_before *= value_beyond / (value_beyond + value);
            beyond = t;
            value_beyond = value;
        } else {
            value_beyond *= value_before / (value_before + value);
            before = t;
            value_before = max(value, range.noise);
        }
        t = before + (beyond - before) * (value_before / (value_before - value_beyond));
        if (abs(value) < 0.003 * range.pixel * t) {
            break;
        }
    }
    return t;
}
