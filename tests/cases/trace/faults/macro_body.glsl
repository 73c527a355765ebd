#define RATIO(a, b) ((a) / (b)) // born +Inf: division by zero
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    float nothing = floor(uv.x);
    fragColor = vec4(RATIO(1.0 + uv.y, nothing));
}
