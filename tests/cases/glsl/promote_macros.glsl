//: --precision double
#define PI 3.14159
#define AA 2
#define V(n) vec##n
#define R(p, a) p = cos(a) * p + sin(a) * vec2(p.y, -p.x)
#define texture2D(a, b) texture(a, b)
#ifdef PI
#if AA > 1
V(3) f(vec2 p) { R(p, PI * 1.); return texture2D(iChannel0, p).xyz; }
#endif
#endif
#if 0
dead 1.0 vec2
#endif
void mainImage(out vec4 c, in vec2 p) { c = vec4(f(p), 1); }
