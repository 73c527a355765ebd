float map(vec3 p) { return length(p) - 1.0; }
vec3 slope(vec3 p) {
    vec2 e = vec2(1e-3, 0.0);
    return normalize(vec3(map(p + e.xyy) - map(p - e.xyy), map(p + e.yxy) - map(p - e.yxy), map(p + e.yyx) - map(p - e.yyx)));
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec3 o = vec3(0.0, 0.0, -3.0), d = normalize(vec3(uv - 0.5, 1.0));
    float t = 0.0;
    for (int i = 0; i < 40; ++i) {
        float h = map(o + t * d);
        if (h < 1e-3 || t > 9.0) break;
        t += h;
    }
    vec3 n = slope(o + t * d);
    fragColor = vec4(t < 9.0 ? 0.5 + 0.5 * n : vec3(0.0), 1.0);
}
