void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(fragCoord.x < 2.0 ? float(iFrame) : 4.0);
}
