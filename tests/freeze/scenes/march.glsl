float map(vec3 p) { return min(length(p) - 1.0, p.y + 1.0); }
void mainImage(out vec4 c, in vec2 f) {
    vec3 ro = vec3(0.0, 0.5, 4.0), rd = normalize(vec3((2.0 * f - iResolution.xy) / iResolution.y, -1.5));
    float t = 0.0;
    for (int i = 0; i < 60; i++) {
        float d = map(ro + rd * t);
        if (d < 0.001) break;
        t += 0.9 * d;
        if (t > 30.0) break;
    }
    c = vec4(vec3(exp(-0.1 * t)), 1.0);
}
