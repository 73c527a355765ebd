struct S { float a[2]; };
void more(inout float x, in float y, inout S s) { x += 0.5; y += 9.0; s.a[1] += 1.0; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float x = 1.0, y = 3.0;
    S s = S(float[2](5.0, 1.0));
    more(x, y, s);
    fragColor = vec4(x, s.a[1], y, 1.0);
}
