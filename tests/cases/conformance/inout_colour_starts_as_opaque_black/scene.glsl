void mainImage(inout vec4 fragColor, in vec2 fragCoord) {
    fragColor.b += fragColor.a;
}
