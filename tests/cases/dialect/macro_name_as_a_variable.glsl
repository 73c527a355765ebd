//: pixel 0 255 0
// A macro with arguments, and a variable of its name before a parenthesis: no call, whatever lines follow.
#define r(v, t) (v = (t))
float twice(float r) { return 2.0 * (r); }
void mainImage(out vec4 o, vec2 p) {
    float r = 0.5;
#if 0
    r = 0.0;
#else
    o = vec4(0, max(twice(r), min(0.0,
             (r))), 0, 1);
#endif
    r(o.a, 1.0);
}
