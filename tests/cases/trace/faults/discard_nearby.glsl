void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    if (uv.x > 0.9)
        discard;
    fragColor = vec4(uv.x / floor(uv.y)); // born +Inf: division by zero
}
