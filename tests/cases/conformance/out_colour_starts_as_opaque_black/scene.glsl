void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor += vec4(0.25, 0.5, 0.75, 0.0);
    fragColor.a -= 1.0;
    fragColor.r += fragColor.a;
}
