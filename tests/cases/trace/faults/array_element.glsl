void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float table[4] = float[4](1.0, uv.x, uv.y, 0.0);
    for (int i = 0; i < 4; ++i)
        table[i] = pow(table[i] - 0.5, 1.5); // born NaN: pow of a negative number
    fragColor = vec4(table[0], table[1], table[2], table[3]);
}
