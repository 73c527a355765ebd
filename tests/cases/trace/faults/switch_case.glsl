void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float v = uv.x;
    switch (int(uv.x * 2.0) + 1) {
    case 0:
        v = 1.0;
        break;
    default:
        v = log(v - 4.0); // born NaN: log of a number that is not above 0
    }
    fragColor = vec4(v);
}
