#iChannel9 "self"
void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel9, ivec2(p), 0) + 9.0; }
