#iChannel0 "grey.png"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 texel = texelFetch(iChannel0, ivec2(0), 0);
    fragColor = texel.a == 1.0 ? texel : vec4(0.0);
}
