
#include "../error_cycle.glsl"
