struct Pair { float a, b; };
float first(float a, vec2) { return a; }
float none(Pair, out float b, const in float[2]) { b = 2.0; return 1.0; }
void mainImage(out vec4 fragColor, in vec2) {
    float b;
    float a = none(Pair(8.0, 9.0), b, float[2](5.0, 6.0));
    fragColor = vec4(a, b, first(3.0, vec2(7.0)), 1.0);
}
