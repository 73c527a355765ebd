void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float dim = pow(uv.x - 1.5, 0.5); // born NaN: pow of a negative number; hidden
    fragColor = vec4(clamp(dim, 0.0, 1.0));
}
