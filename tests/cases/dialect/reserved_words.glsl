//: pixel 0 255 0
struct sample_t { float packed; int row_major; };
float buffer(float shared) { return shared; }
void mainImage(out vec4 o, vec2 p) {
    sample_t s = sample_t(1.0, 2);
    float sample = buffer(s.packed), precise = 1.0, patch = 0.0, subroutine = 0.0, active = 0.0;
    vec2 input = vec2(0), output = input, filter = output;
    o = vec4(patch + filter.x + active + subroutine, sample * precise, 0.0, 1.0);
}
