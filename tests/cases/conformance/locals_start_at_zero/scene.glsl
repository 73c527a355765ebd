void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float i, d; vec3 p; int n;
    for (; n < 4; n++) { i += 1.0; p.x += i; }
    fragColor = vec4(i, d, p.x, 1.0);
}
