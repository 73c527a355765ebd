struct Wave { float height; float steepness; };
Wave wave(float x) {
    Wave w;
    w.height = x;
    w.steepness = x / floor(x); // born +Inf: division by zero
    return w;
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(wave(uv.x).steepness);
}
