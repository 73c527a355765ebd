void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float edge = floor(uv.x * 0.5);
    float shade = uv.y / edge; // born +Inf: division by zero
    fragColor = vec4(shade);
}
