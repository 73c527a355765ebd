// What the air leaves of a colour: 1 at the eye, 0 far away, for densities >= 0. No overflow gives anything
// but 0.
#ifndef LIB_FOG
#define LIB_FOG

// exp(-density d^3): hardly any fog near by, then a wall. `density` per unit cubed.
float cubic_clearness(float distance, float density) {
    return exp(-density * distance * distance * distance);
}

// exp(-(density d)^2): the EXP2 fog of engines. `density` per unit.
float squared_clearness(float distance, float density) {
    float depth = density * distance;
    return exp(-depth * depth);
}
#endif
