//: pixel 0 255 0
void mainImage(out highp vec4 o, const in vec2 p) { o = vec4(0, 1, 0, 1); }
