void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float w = fwidth(uv.x) + abs(dFdx(uv.y)) + 1e-4;
    fragColor = vec4(smoothstep(0.5 - w, 0.5 + w, uv.x));
}
