void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec2 far = (uv + 1.0) * 3e19;
    float reach = length(far); // born +Inf: overflow: the squares are beyond the largest float
    fragColor = vec4(reach);
}
