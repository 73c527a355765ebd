#iChannel0 "Buffer A"
void mainImage(out vec4 c, in vec2 p) { c = vec4(level(texelFetch(iChannel0, ivec2(p), 0)), 0.2, 0.4, 1.0); }
