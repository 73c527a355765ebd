#iChannel0 "faces.png"
#iChannel0::Type "CubeMap"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(iChannelResolution[0], 1.0) + 0.0 * texture(iChannel0, vec3(1.0));
}
