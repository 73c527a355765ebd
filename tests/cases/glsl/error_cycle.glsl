void mainImage(out vec4 fragColor, in vec2 fragCoord) {}

#include "lib/cycle.glsl"
