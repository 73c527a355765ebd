void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float ripple = 0.5 + 0.5 * sin(40.0 * length(uv - 0.5) - 4.0 * iTime);
    fragColor = vec4(mix(vec3(0.0, 0.2, 0.4), vec3(0.5, 0.8, 0.9), ripple), 1.0);
}
