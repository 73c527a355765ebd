void mainImage(out vec4 c, in vec2 p) {
    float unused = 1.0;
    c = vec4(nowhere, p.xyz);
}
