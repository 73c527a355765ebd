#iChannel0 "buffer_a"
#iChannel1 "cube_a"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 a = texelFetch(iChannel0, ivec2(0), 0);
    vec4 b = texture(iChannel1, vec3(1.0, 0.0, 0.0));
    fragColor = vec4(a.r, b.g, a.a + b.a, 1.0);
}
