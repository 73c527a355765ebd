//: --precision double
precision highp float;
struct Ray { highp vec3 origin; float length[2]; };
mat2x3 m = mat2x3(1., 2., 3., 4, 5, 6);
uniform vec4 tint;
lowp float weight(in mediump float x, const vec2 p, out vec3 q) {
    q = vec3(p, .5);
    int i = 0x1F, k = 3;
    uint u = 7u;
    return 1e-3 + 2.5E+2 + 1.f + 1..xx.x + x * float(i) - 3.;
}
void mainImage(out vec4 c, in vec2 p) { c = tint; }
