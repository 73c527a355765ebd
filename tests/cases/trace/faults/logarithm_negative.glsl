void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(log2(uv.x - 3.0)); // born NaN: log2 of a number that is not above 0
}
