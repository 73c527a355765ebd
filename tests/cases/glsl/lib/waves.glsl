#include "constants.glsl"
#iUniform float steepness = 0.5
float wave(float x) { return steepness * sin(x); }
