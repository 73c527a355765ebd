void bend(inout vec3 p) {
    p.xz *= 1.0 / p.y; // born +Inf: division by zero
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec3 p = vec3(uv + 1.0, 1.0);
    p.y = floor(uv.y);
    bend(p);
    fragColor = vec4(p, 1.0);
}
