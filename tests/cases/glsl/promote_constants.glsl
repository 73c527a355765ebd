//: --precision double
const float a = 0.5, b = sqrt(a);
const float angle = radians(30.);
const int n = int(3. * 2.);
#define SPIN sin(angle)
const mat2 turn = mat2(SPIN, a, a, 1.);
const mat2 again = turn * 2.;
float list[n];
float f(const float x, const in vec2 y) {
    const float local = exp(1.);
    return x + local;
}
void mainImage(out vec4 c, in vec2 p) { c = vec4(again[0], turn[1]) + b; }
