#define TWICE(x) (2.0 * (x))
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(TWICE(sqrt(-1.0 - uv.x))); // born NaN: sqrt of a negative number
}
