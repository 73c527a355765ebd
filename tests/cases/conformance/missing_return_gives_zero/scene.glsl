struct S { float a; vec2 b[2]; };
float number(float x) { if (x > 1.0) return 7.0; }
S structure(float x) { if (x > 1.0) { return S(1.0, vec2[2](vec2(3.0), vec2(4.0))); } }
float[100] list(float x) {
    float a[100];
    for (int i = 0; i < 100; ++i)
        a[i] = 9.0;
    if (x > 1.0)
        return a;
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    S s = structure(fragCoord.x);
    float[100] a = list(fragCoord.x);
    fragColor = vec4(number(fragCoord.x), s.a + s.b[0].x + s.b[1].y, a[42], 1.0);
}
