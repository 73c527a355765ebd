#iChannel0 "buffer_a"
#iChannel0::MinFilter "LinearMipMapLinear"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = textureLod(iChannel0, vec2(0.5), 2.0);
}
