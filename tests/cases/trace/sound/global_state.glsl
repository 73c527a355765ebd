vec3 state = vec3(1.0);
float seed;
float next() { seed = fract(seed * 17.3 + 0.1); return seed; }
void shift() { state.xy += vec2(next(), next()); }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    seed = uv.x;
    shift();
    fragColor = vec4(state, next());
}
