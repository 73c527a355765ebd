const vec2 corners[3] = vec2[3](vec2(0.0), vec2(1.0), vec2(0.5));
float total(float values[3]) { return values[0] + values[1] + values[2]; }
float[3] triple(float x) { return float[3](x, 2.0 * x, 3.0 * x); }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float w[] = float[](1.0, 2.0, 3.0);
    float[3] v = triple(uv.x);
    fragColor = vec4(corners[1] * total(w), total(v), float(w.length()));
}
