void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float zero = iTime * 0.0;
    fragColor = vec4(-3.5, 1267650600228229401496703205376.0, 1.0 / zero, uintBitsToFloat(0x7fc00000u + uint(iTime)));
}
