#iChannel0 "eight.bin"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 at = ivec2(fragCoord);
    fragColor = texelFetch(iChannel0, ivec3(at.x % 2, at.y, at.x / 2), 0);
}
