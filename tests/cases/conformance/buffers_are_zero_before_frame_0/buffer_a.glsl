#iChannel0 "self"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 last = texelFetch(iChannel0, ivec2(fragCoord), 0);
    fragColor = iFrame == 0 ? vec4(last == vec4(0.0) ? 7.0 : -1.0) : last;
}
