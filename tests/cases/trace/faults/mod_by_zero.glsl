void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float cell = mod(uv.x + 1.0, floor(uv.y)); // born NaN: mod by 0
    fragColor = vec4(cell);
}
