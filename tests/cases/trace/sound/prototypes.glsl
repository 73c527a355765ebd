float later(float);
void nothing(void);
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    nothing();
    fragColor = vec4(later(uv.x));
}
float later(float x) { return x * x; }
void nothing() {}
