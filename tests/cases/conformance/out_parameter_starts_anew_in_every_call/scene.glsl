void raise(out float a, float b) { a += b; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float a = 7.0, b = 4.0;
    for (int i = 0; i < 3; ++i)
        raise(a, 3.0);
    raise(b, b);
    vec4 c = vec4(9.0);
    raise(c.z, 1.0);
    fragColor = vec4(a, b, c.z, 1.0);
}
