#iChannel0 "buffer_a"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 drawn = texelFetch(iChannel0, ivec2(0), 0);
    fragColor = vec4(drawn.rg, drawn.a, 0.0);
}
