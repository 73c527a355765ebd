void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float angle = asin(-uv.x - 1.5); // born NaN: asin outside of [-1, 1]
    fragColor = vec4(angle);
}
