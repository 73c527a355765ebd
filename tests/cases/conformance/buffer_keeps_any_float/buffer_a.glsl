void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float zero = iTime * 0.0;
    fragColor = vec4(-3.5, 1e30, 1.0 / zero, zero / zero);
}
