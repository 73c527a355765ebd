void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int at = int(fragCoord.x);
    fragColor = vec4(128.0 / 255.0);
    st_assert(at != 1);
    st_assert(at != 2, 1);
    st_assert(at != 3, 2);
    st_assert(at != 4, 3);
}
