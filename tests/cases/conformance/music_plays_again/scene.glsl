#iChannel0 "half.wav"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(iChannelTime[0] * 100.0, texelFetch(iChannel0, ivec2(256, 1), 0).r * 255.0, 0.0, 1.0);
}
