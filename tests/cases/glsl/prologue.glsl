//: --prologue
#iUniform vec2 centre = vec2(0.5, 0.5)
#iUniform int steps = 8 in { 1, 64 }
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(fragCoord / iResolution.xy - centre, float(steps), 1.0);
}
