// one \
   still the same comment
/* float x = 1.0 / 0.0; */
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(uv /* in between */, 0.0, 1.0); // behind
}
