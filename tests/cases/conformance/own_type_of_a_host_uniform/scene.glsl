uniform mat2 iResolution;
uniform mat3 iCamera;
uniform vec2 iMouse;
uniform float iFrame;
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(iResolution[0][0] + iResolution[1][1] + iCamera[0][0] + iCamera[2][2], iMouse.y, iFrame, 1.0);
}
