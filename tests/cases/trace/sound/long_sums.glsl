// Products that go into sums, sums of many, differences that lose digits and do not show them.
float wave(vec2 p, float turn) {
    return 0.5 + 0.25 * sin(p.x * 6.0 + turn) - 0.125 * cos(p.y * 9.0 - turn) + 0.0625 * sin(p.x + p.y + turn);
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    mat2 turned = mat2(0.8, 0.6, -0.6, 0.8);
    vec2 q = turned * uv * 2.0 + uv - 0.5;
    float error = q.x * q.x - q.x * q.x, sum = 1.0 - dot(q, q) * 0.01 + q.x - q.y;
    sum -= q.x * q.y * 0.1;
    ivec2 cell = ivec2(floor(q * 3.0)) * 2 + 1;
    fragColor = vec4(wave(q, 0.7), error + 0.5, fract(0.01 * sum + 0.001 * float(cell.x * 3 + cell.y - 7)), 1.0);
}
