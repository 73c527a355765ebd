float hash(vec2 p) {
    return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453);
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float level = 0.5 + 0.1 * sin(iTime);
    float wave = 0.5 + 0.3 * sin(12.0 * uv.x + iTime);
    float foam;
    foam = sqrt(wave - level) * (0.5 + 0.5 * hash(floor(fragCoord / 4.0)));
    fragColor = vec4(vec3(foam), 1.0);
}
