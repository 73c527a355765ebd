void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float shade = uv.x > 2.0 ? 1.0 / floor(uv.x)
                             : sqrt(uv.x - 1.5); // born NaN: sqrt of a negative number
    fragColor = vec4(shade);
}
