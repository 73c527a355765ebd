void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float step = 4.0, sum = 0.0;
    while (sum < 1e9) {
        step -= 1.0;
        sum += uv.x + 1.0 / step; // born +Inf: division by zero; iteration 4
    }
    fragColor = vec4(sum);
}
