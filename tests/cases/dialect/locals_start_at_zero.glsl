//: pixel 0 255 0
#define V vec3
#define LOOP(n) for (int k; k < n; k++)
float sum, other = 2., last;
struct S { float a, b; };
vec2 two(float x, vec2 y) { vec2 r; r += x * y; return r; }
void mainImage(out vec4 O, vec2 U) {
    float i, a[2], d = 1., s;
    V p, q = V(0);
    mat2 m;
    bool done;
    uint n;
    S t = S(0., 0.);
    for (float e, g; i++ < 4.; s += e + g) e += .0;
    LOOP(3) s += 0.;
    if (!done && n == 0u) sum += m[0][0] + p.x + last;
    O = vec4(s + sum + q.x + t.a + two(0., U).x, d, other - 2., 1);
}
