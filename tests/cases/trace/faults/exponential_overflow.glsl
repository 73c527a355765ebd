void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float glow = exp(uv.x + 100.0); // born +Inf: overflow: beyond the largest float
    fragColor = vec4(glow);
}
