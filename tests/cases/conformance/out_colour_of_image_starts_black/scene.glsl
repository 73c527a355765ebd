void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    if (fragCoord.x < 0.0)
        fragColor = vec4(1.0);
    fragColor.r += 0.25;
    fragColor.b += fragColor.a == 0.0 ? 1.0 : 0.0;
}
