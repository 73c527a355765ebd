void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float beat = sin(iTime) / iTime; // born NaN: 0 / 0
    fragColor = vec4(beat + uv.x);
}
