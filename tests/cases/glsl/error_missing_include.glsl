#include "lib/../lib/nowhere.glsl"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {}
