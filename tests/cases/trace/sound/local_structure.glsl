void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    struct Local { float a; vec2 b; } l = Local(1.0, uv);
    l.b /= 2.0;
    fragColor = vec4(l.a, l.b, 1.0);
}
