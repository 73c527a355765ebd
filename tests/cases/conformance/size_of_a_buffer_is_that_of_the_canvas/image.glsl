#iChannel0 "buffer_a"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(iChannelResolution[0], 1.0) + texelFetch(iChannel0, ivec2(fragCoord), 0) * 0.0;
}
