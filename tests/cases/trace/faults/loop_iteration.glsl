void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float sum = 0.0;
    for (int i = 0; i < 9; ++i)
        sum += 1.0 / float(6 - i) + uv.x; // born +Inf: division by zero; iteration 7
    fragColor = vec4(sum);
}
