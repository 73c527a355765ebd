#iChannel0 "cube_a"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor.rgb = fragCoord.x < 1.0 ? texture(iChannel0, vec3(1.0, 0.2, 0.3)).rgb : iChannelResolution[0];
}
