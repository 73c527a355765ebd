// Derivatives before anybody leaves, behind exits that all take together, and where a loop has brought pixels
// back together.
float soft(float x) { return fwidth(x) + 0.01; }
float fade(float x) {
    if (x < 0.2) return 0.0;
    return x;
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float width = soft(uv.x), sum = 0.0;
    fragColor = vec4(0.0, 0.0, 0.0, 1.0);
    if (iTime < 0.0) return;
    for (int i = 0; i < 4; ++i) {
        sum += soft(uv.y * float(i + 1));
        if (uv.x > 0.25 * float(i)) continue;
        sum += 0.1;
    }
    fragColor.xyz = vec3(smoothstep(0.5 - width, 0.5 + width, uv.x), fade(uv.y), sum + dFdx(sum));
    if (uv.x > 0.9) discard;
}
