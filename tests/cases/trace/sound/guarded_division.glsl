void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float d = floor(uv.x);
    fragColor = vec4(d == 0.0 ? 0.0 : uv.y / d);
}
