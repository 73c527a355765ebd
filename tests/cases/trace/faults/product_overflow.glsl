void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float big = (uv.x + 1.0) * 1e30;
    big *= big; // born +Inf: overflow: beyond the largest float
    fragColor = vec4(big);
}
