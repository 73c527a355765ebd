void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(iSampleRate, iChannelTime[0], iChannelTime[3], 1.0);
}
