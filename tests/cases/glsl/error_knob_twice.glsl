#include "lib/waves.glsl"
#iUniform int steepness = 1
void mainImage(out vec4 fragColor, in vec2 fragCoord) {}
