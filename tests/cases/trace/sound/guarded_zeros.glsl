// Zeros that are divided by something else, whatever the pixel.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec2 side = floor(2.0 * uv);
    vec2 toward = side / max(length(side), 1e-6);
    float part = side.x > 0.0 ? side.x / side.x : 0.0;
    fragColor = vec4(toward, part, 1.0);
    fragColor.xy /= 1.0 + side.yx;
}
