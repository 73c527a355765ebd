float zero = 0.0;
float gain = 1.0 / zero; // born +Inf: division by zero
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(gain * (uv.x + 1.0));
}
