#iChannel2 "wide.png"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(iChannelResolution[2], 1.0) + 0.0 * texture(iChannel2, fragCoord);
}
