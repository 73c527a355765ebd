//: pixel 0 128 0
#define GREEN .5
void mainImage(out vec4 O, vec2 U) { O.g += GREEN; }
