//: pixel 0 255 0
uniform float iGlobalTime;
vec4 f(vec2 p) { return texture2D(iChannel0, p) + texture2DLodEXT(iChannel0, p, 0.0) + texture2DLod(iChannel0, p, 0.0); }
void mainImage(out vec4 o, vec2 p) { o = vec4(0.0 * f(p).r, 1.0, 0.0 * iGlobalTime, 1.0); }
