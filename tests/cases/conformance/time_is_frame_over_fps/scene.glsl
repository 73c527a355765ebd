void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    int x = int(fragCoord.x);
    fragColor.r = x == 0 ? iTime : x == 1 ? iTimeDelta : x == 2 ? float(iFrame) : iFrameRate;
}
