//: --precision double
float tanh(float x) { float e = exp(2. * x); return (e - 1.) / (e + 1.); }
vec3 pow(vec3 x, float y) { return pow(x, vec3(y)); }
float log10(float x) { return log(x) / log(10.); }
struct Wave { float sin; };
void mainImage(out vec4 c, in vec2 p) {
    Wave w = Wave(1.);
    float cos = w.sin;
    c = vec4(tanh(p.x), tanh(p), dFdxFine(cos)) + mod(p.x, 2.) + mix(1., cos, .5) + sqrt(2.);
}
