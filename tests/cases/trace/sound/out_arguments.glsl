void polar(vec2 p, out float r, out float a) { r = length(p); a = r > 0.0 ? atan(p.y, p.x) : 0.0; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float r, a, whole;
    polar(uv, r, a);
    float rest = modf(4.0 * r, whole);
    int power;
    float part = frexp(r + 1.0, power);
    fragColor = vec4(rest, whole, part, a);
}
