void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    uint b = floatBitsToUint(uv.x + 1.0);
    b = (b & 0x007fffffu) | 0x3f800000u;
    int k = int(b >> 3u) % 7 << 1;
    fragColor = vec4(uintBitsToFloat(b) - 1.0, float(k ^ 5) / 16.0, 0.0, 1.0);
}
