float pick(float x) { if (x < 0.5) return 0.0; else if (x < 0.7) { return 1.0; } return 2.0; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(pick(uv.x));
    if (uv.y > 0.5) return;
    fragColor.x = 0.0;
}
