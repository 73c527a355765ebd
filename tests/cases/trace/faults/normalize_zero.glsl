void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec3 toward = vec3(floor(uv), 0.0);
    vec3 light = normalize(toward); // born NaN: normalize of a vector whose squares add up to 0
    fragColor = vec4(light, 1.0);
}
