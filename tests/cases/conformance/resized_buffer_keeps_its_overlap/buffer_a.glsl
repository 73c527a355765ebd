#iChannel0 "self"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = iFrame == 0 ? vec4(fragCoord, 5.0, 1.0) : texelFetch(iChannel0, ivec2(fragCoord), 0);
}
