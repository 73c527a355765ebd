#iKeyboard
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = fragCoord.x < 1.0 ? vec4(isKeyDown(Key_A), isKeyPressed(Key_A), isKeyToggled(Key_A), 1.0)
                                  : vec4(isKeyReleased(Key_A), textureSize(iKeyboard, 0).y == 4,
                                         isKeyDown(Key_LeftArrow), 1.0);
}
