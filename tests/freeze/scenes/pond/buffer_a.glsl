#iChannel0 "Buffer A"
void mainImage(out vec4 c, in vec2 p) {
    c = texelFetch(iChannel0, ivec2(p), 0) + vec4(p / 37.0, 1.0e6 / 3.0, -0.5);
}
