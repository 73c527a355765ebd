// Zeros are divided by zeros nowhere, or where nobody looks.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec2 side = floor(2.0 * uv);
    float unseen = side.x / side.x;
    vec2 toward = side / max(length(side), 1e-6);
    fragColor = vec4(toward, side.x > 0.0 ? unseen : 0.0, 1.0);
    fragColor.xy /= 1.0 + side.yx;
}
