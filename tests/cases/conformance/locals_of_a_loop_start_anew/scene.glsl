struct S { float x; float y[3]; };
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float sum = 0.0, structs = 0.0, clauses = 0.0;
    for (int i = 0; i < 4; ++i) {
        float one;
        vec2 a[3];
        one += 0.5;
        a[i % 3].y += 0.5;
        sum += one + a[0].y + a[1].y + a[2].y;
    }
    int n;
    do {
        S s;
        s.y[n] += 1.0;
        structs += s.y[0] + s.y[1] + s.y[2] + s.x;
    } while (++n < 3);
    for (float i, k; i < 4.0; ++i) {
        k += 1.0;
        clauses += k;
    }
    fragColor = vec4(sum, structs, clauses, 1.0);
}
