#define D -1.0
#define P +1.0
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float a = uv.x;
    float b = - -a + +a - -D + - P;
    int i = 3; i = i++ + ++i; i = -i-- - --i;
    fragColor = vec4(b, float(i), 0.0, 1.0);
}
