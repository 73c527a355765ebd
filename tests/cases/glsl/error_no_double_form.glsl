//: --precision double

void mainImage(out vec4 c, in vec2 p) {
    c = vec4(1);
    gl_FragDepth = .5;
}
