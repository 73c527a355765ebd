void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec3 c = vec3(uv, 1.0);
    c.xy /= floor(uv.x); // born +Inf: division by zero
    fragColor = vec4(c, 1.0);
}
