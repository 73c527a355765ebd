#define KIND 3.0
#include "cell.glsl"
