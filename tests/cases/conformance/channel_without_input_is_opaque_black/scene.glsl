void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(texture(iChannel1, vec2(0.5)).ra, iChannelResolution[1].x, 1.0);
}
