//: --precision double
#define SEED 43758.5453
float hash(float n) { return fract(sin(n) * 43758.5453); }
vec2 hash2(in vec2 p, const int k) {
    float d = dot(p, vec2(127.1, 311.7)), e = float(k);
    return fract(sin(vec2(d, e)) * SEED * iTime) + hash(d) + 1e4 * 0.;
}
float smooth_(vec2 p) {
    vec2 i = floor(p);
    return mix(hash(i.x), hash2(i, 3).y, fract(p.x));
}
void mainImage(out vec4 c, in vec2 p) { c = vec4(smooth_(p), hash(p.x), 0, 1); }
