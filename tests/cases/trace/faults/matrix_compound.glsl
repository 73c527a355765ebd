void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    mat2 turn = mat2(1.0, uv.x, uv.y, 1.0);
    turn /= floor(uv.x); // born +Inf: division by zero
    fragColor = vec4(turn[0], turn[1]);
}
