void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(sqrt(max(uv.x - 0.5, 0.0)), pow(max(uv.y - 0.5, 0.0), 0.45), 0.0, 1.0);
}
