//: --precision double
float hash12(vec2 p) {
    vec3 q = fract(vec3(p.xyx) * .1031);
    q += dot(q, q.yzx + 33.33);
    return fract((q.x + q.y) * q.z);
}
float hash11(float p) { p = fract(p * .1031); p *= p + 33.33; p *= p + p; return fract(p); }
float triangles(vec2 p, float s) { return abs(fract(p.x * s) - .5) + abs(fract(p.y * s) - .5); }
float dither(vec2 p) { return fract(52.98 * fract(dot(p, vec2(.067, .0058)))); }
uint bits(float x) { return floatBitsToUint(x); }
void mainImage(out vec4 c, in vec2 p) { c = vec4(hash12(p), hash11(p.x), triangles(p, 2.), dither(p)); }
