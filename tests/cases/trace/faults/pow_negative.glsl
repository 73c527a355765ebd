void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec3 tint = vec3(uv, 0.5) - 0.9;
    fragColor = vec4(pow(tint, vec3(0.4545)), 1.0); // born NaN: pow of a negative number
}
