#define KIND 4.0
#include "cell.glsl"
