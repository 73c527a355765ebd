float root(float x) {
    return sqrt(x); // born NaN: sqrt of a negative number; called from 6
}
vec2 roots(float x) {
    float good = root(x);
    return vec2(good, root(x - 5.0));
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(roots(uv.x), 0.0, 1.0);
}
