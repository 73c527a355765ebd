void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec3 d = normalize(vec3(uv - 0.5, 1.0));
    vec3 inv = 1.0 / vec3(0.0, d.yz);
    vec3 a = (vec3(-1.0) - vec3(0.1)) * inv, b = (vec3(1.0) - vec3(0.1)) * inv;
    vec3 lo = min(a, b), hi = max(a, b);
    float near = max(max(lo.x, lo.y), lo.z), far = min(min(hi.x, hi.y), hi.z);
    fragColor = vec4(near < far ? 1.0 : 0.0);
}
