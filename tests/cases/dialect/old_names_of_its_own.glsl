//: pixel 0 255 0
#define texture2D(s, p) texture(s, p) * 0.0
vec4 textureCube(sampler2D s, vec3 p) { return texture2D(s, p.xy); }
float iGlobalTime = 1.0;
void mainImage(out vec4 o, vec2 p) { o = vec4(textureCube(iChannel0, vec3(p, 0.0)).r, iGlobalTime, 0.0, 1.0); }
