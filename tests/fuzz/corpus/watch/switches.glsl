void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float v = 0.0;
    switch (int(fragCoord.x) & 3) {
    case 0: v = 0.1; break;
    case 1: { v = 0.2; break; }
    case 2:
    case 3: v += 0.3;
    default: v *= 0.5;
    }
    fragColor = vec4(v);
}
