//: pixel 0 0 0
void mainImage(out vec4 o, vec2 p) { o = vec4(0, 0, 0, 1); st_assert(true, 1); }
