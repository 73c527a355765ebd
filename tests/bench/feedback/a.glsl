#define KIND 1.0
#include "cell.glsl"
