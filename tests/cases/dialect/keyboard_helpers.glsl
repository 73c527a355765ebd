//: keyboard
//: pixel 0 255 0
void mainImage(out vec4 o, vec2 p) {
    bool any = isKeyDown(Key_A) || isKeyPressed(Key_LeftArrow) || isKeyToggled(Key_F5) || isKeyReleased(Key_Space);
    o = vec4(any ? 1.0 : 0.0, 1.0, 0.0, 1.0);
}
