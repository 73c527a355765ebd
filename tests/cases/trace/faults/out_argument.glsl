void split(float x, out float whole, out float rest) {
    whole = floor(x);
    rest = x / floor(whole * 0.1); // born +Inf: division by zero
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float a, b;
    split(uv.x + 1.0, a, b);
    fragColor = vec4(a, b, 0.0, 1.0);
}
