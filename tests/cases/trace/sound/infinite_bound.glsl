void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float nearest = uintBitsToFloat(0x7f800000u);
    for (int i = 0; i < 4; ++i) nearest = min(nearest, distance(uv, vec2(float(i) * 0.3)));
    fragColor = vec4(nearest);
}
