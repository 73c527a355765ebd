uint mixed(uint x) { x ^= x >> 16u; x *= 0x7feb352du; x ^= x >> 15u; return x; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(float(mixed(uint(fragCoord.x) + 9u * uint(fragCoord.y))) / 4294967296.0);
}
