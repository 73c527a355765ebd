struct S { float a; float b; };
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float x;
    S s;
    vec2 v[2];
    if (fragCoord.x > 1.0) {
        x = 1.0;
        s.b = 2.0;
        v[1].y = 3.0;
    }
    switch (int(fragCoord.y)) {
    case 0:
        float inside;
        s.b += inside;
    default:
        x += s.a;
    }
    fragColor = vec4(x, s.b, v[1].y, 1.0);
}
