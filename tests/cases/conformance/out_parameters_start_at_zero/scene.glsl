struct Hit { float t; vec3 normal; int kind[2]; };
float march(float x, out bool hit) {
    for (int i = 0; i < 2; ++i)
        if (x > float(i) + 1.0)
            hit = true;
    return x;
}
void tint(out vec4 c) { c.y += 0.25; }
void meet(out Hit hit) { hit.normal.y += 0.5; hit.kind[1] += 2; }
void fill(out float a[5], out mat2 m) { a[3] += 1.0; m[1].x += 1.0; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    bool hit = true;
    march(fragCoord.x, hit);
    vec4 c = vec4(1.0);
    tint(c);
    Hit h = Hit(1.0, vec3(1.0), int[2](1, 1));
    meet(h);
    float a[5] = float[5](9.0, 9.0, 9.0, 9.0, 9.0);
    mat2 m = mat2(9.0);
    fill(a, m);
    float other = a[0] + a[4] - a[3] + m[0].x + m[1].x + m[1].y + h.t + h.normal.x + float(h.kind[0]) + c.x + c.w;
    fragColor = vec4(hit ? 1.0 : 0.0, c.y + other, h.normal.y + float(h.kind[1]), 1.0);
}
