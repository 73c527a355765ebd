#iKeyboard
#iChannel0 "keyboard"
void mainImage(out vec4 c, in vec2 p) {
    c = vec4(abs(iMouse.xy) / iResolution.xy, texelFetch(iChannel0, ivec2(65, 0), 0).x, 1.0);
}
