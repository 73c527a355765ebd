#iChannel0 "buffer_a"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 kept = texelFetch(iChannel0, ivec2(fragCoord), 0);
    bool infinite = floatBitsToInt(kept.b) == 0x7f800000;
    bool nan = (floatBitsToInt(kept.a) & 0x7fffffff) > 0x7f800000;
    fragColor = vec4(kept.r, infinite && kept.g == 1267650600228229401496703205376.0 ? 1.0 : 0.0, nan ? 1.0 : 0.0, 1.0);
}
