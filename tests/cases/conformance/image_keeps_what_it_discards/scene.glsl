void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    if (iFrame > 0 && fragCoord.x < 1.0)
        discard;
    fragColor = vec4(float(iFrame + 1));
}
