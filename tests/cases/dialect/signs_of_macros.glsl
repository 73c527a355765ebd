//: pixel 0 255 0
#define N(x) -x
#define P(x) + x
#define D(a, b) (a-b)
#define T(a, b, k,) a*(1.-k)+b*k
#define END 1.-
#define R(x) x*1.
void mainImage(out vec4 o, vec2 p) {
    float one = 1.;
    o = vec4(one-N(-one), -N(one)+P(0.)+0., D(1., one) * END-one-one, 1);
    o.g *= -R(-one) * N(R(-one));
    o.r *= T(0., 0., .5) + D(-one, -one);
}
