//: --precision double
void mainImage(out vec4 c, in vec2 p) {
    c = texture(iChannel0, p / 64.) + textureLod(iChannel0, p, 0.) + texelFetch(iChannel0, ivec2(p), 0);
    c += textureOffset(iChannel0, p * 2., ivec2(1, 0)) + textureGather(iChannel0, p + .5, 1);
    c += textureLodOffset(iChannel0, p, mod(p.x, 2.), ivec2(1));
    c.xy *= vec2(textureSize(iChannel0, 0));
    c.z = uintBitsToFloat(1u);
}
