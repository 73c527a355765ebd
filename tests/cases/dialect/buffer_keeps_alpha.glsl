//: buffer
//: pixel 0 255 0 0
void mainImage(out vec4 o, vec2 p) { o = vec4(0, 1, 0, 0); }
