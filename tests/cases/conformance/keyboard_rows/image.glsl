#iChannel0 "keyboard"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(texelFetch(iChannel0, ivec2(65, 0), 0).r, texelFetch(iChannel0, ivec2(65, 1), 0).r,
                     texelFetch(iChannel0, ivec2(65, 2), 0).r, 1.0);
}
