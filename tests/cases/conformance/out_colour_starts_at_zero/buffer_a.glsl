void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor.rg += vec2(0.25, 0.5);
}
