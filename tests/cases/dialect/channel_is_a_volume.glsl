//: pixel 0 255 0
vec4 fetch(sampler3D s, vec3 p) { return textureLod(s, p, 0.0) + texelFetch(s, ivec3(p), 0); }
void mainImage(out vec4 o, vec2 p) { o = vec4(0.0 * fetch(iChannel2, vec3(p, 1)).x, 1, 0.0 * texture(iChannel3, vec3(p, 1)).x, 1); }
