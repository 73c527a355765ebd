#define KIND 2.0
#include "cell.glsl"
