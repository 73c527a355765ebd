float twice(float x) { return 2.0 * x; }
vec2 twice(vec2 x) { return 2.0 * x; }
int twice(int x) { return 2 * x; }
void twice(inout vec3 x) { x *= 2.0; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    vec3 c = vec3(twice(uv), twice(uv.x));
    twice(c);
    fragColor = vec4(c, float(twice(3)));
}
