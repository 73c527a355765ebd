void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float s = 0.0;
    int n = 3;
    do { s += 0.1; } while (--n > 0);
    while (s < 1.0) s += 0.25;
    for (;;) { if (s > 2.0) break; s *= 1.5; if (s > 1.9) continue; }
    for (int i = 0, k = 9; i < k; ++i, --k) s -= 0.01;
    fragColor = vec4(s);
}
