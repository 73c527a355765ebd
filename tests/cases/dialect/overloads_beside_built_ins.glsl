//: pixel 102 153 51
// On a desktop a function of the author's hides all built-in ones of its name; here both are called.
struct Blend { float mix; };
#define HALF(a, b) mix(a, b, 0.5)
vec3 mix(vec3 a, vec3 b, bool c) { return mix(a, b, float(c)); }
float cross(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }
vec4 texture(sampler2D s, vec3 p) { return texture(s, p.xy) * 0.0 + texture(s, p.yz, 0.0) * 0.0; }
float max(float a, float b) { return a > b ? a : b; }
float max(float a, float b, float c) { return max(max(a, b), c); }
float modf(float a) { float whole; return modf(a, whole) + whole * 0.0; }
float length(int[3] list) { return float(list.length()); }
void mainImage(out vec4 o, vec2 p) {
    Blend blend = Blend(0.2);
    o = vec4(mix(vec3(1), vec3(blend.mix), true), 1); // 0.2
    o.r *= float(min(ivec2(3), 2).y) * mix(vec2(7), vec2(1), bvec2(true)).x; // 0.4
    o.g *= cross(vec2(1, 0), vec2(0, 1)) + cross(vec3(1, 0, 0), vec3(0, 1, 0)).z + max(0.1, 1.0, 0.3); // 0.6
    o.b *= HALF(0.0, 2.0) + modf(3.0) + length(int[3](1, 2, 3)) - 3.0 + length(vec2(0)); // 0.2
    o += texture(iChannel0, vec3(p, 0)) + float(max(-1, int(max(uvec2(0), 0u).x)));
}
