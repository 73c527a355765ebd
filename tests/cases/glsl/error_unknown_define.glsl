//: --define OCTAVE=3
#define OCTAVES 7
void mainImage(out vec4 fragColor, in vec2 fragCoord) {}
