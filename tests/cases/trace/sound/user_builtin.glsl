float pow(float x, int n) { float r = 1.0; for (int i = 0; i < n; ++i) r *= x; return r; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(pow(uv.x - 0.5, 3));
}
