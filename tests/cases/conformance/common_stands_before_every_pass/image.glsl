#iChannel0 "buffer_a"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(twice(texelFetch(iChannel0, ivec2(fragCoord), 0).r), shared_value, float(__LINE__ - first_line), 1.0);
}
