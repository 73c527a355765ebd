#if HW_PERFORMANCE != 1
#error this is not ShaderToy
#endif
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(float(HW_PERFORMANCE));
}
