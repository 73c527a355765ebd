#define PI 3.14159265
#define TURN(a) mat2(cos(a), -sin(a), sin(a), cos(a))
#define PAIR(x, y) vec2(x, y)
#define EACH(n) for (int n = 0; n < 4; ++n)
#define JOIN(a, b) a##b
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec2 JOIN(po, int) = TURN(PI * 0.25) * PAIR(uv.x, uv.y);
    float sum = 0.0;
    EACH(i) { sum += point.x; }
    fragColor = vec4(sum);
}
