void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float falloff = inversesqrt(floor(uv.x)); // born +Inf: inverse square root of zero
    fragColor = vec4(falloff);
}
