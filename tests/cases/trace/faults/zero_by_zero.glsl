void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float none = floor(uv.x * 0.5);
    vec2 ratio = vec2(none, 1.0) / vec2(none, 2.0); // born NaN: 0 / 0
    fragColor = vec4(ratio, 0.0, 1.0);
}
