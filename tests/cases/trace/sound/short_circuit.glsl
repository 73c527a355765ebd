void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float d = floor(uv.x);
    bool far = d != 0.0 && 1.0 / d > 0.5 || d > 3.0 ^^ false;
    fragColor = vec4(far ? 1.0 : 0.0);
}
