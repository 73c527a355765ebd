//: pixel 0 255 0
void mainImage(out vec4 O, vec2 U) { O -= O; O += vec4(0, 1, 0, 0); }
