#iChannel0 "cube_a"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec3 to = fragCoord.x < 1.0 ? vec3(1, 0.5, 0.25) : fragCoord.x < 2.0 ? vec3(-0.5, -1, 0.25)
                                                     : vec3(0.25, 0.5, -1);
    fragColor = vec4(texture(iChannel0, to).rgb - normalize(to), 1.0);
}
