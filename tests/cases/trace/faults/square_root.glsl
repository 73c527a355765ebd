void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float lens = sqrt(uv.x - 2.0); // born NaN: sqrt of a negative number
    fragColor = vec4(lens);
}
