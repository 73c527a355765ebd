#iChannel0 "sine.wav"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = texelFetch(iChannel0, ivec2(int(fragCoord.x) + 42, 0), 0);
}
