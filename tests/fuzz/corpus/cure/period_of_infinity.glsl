uniform float iTime;
float f(float x) { return mod(iTime, 2.0 / 0.0) + sin(1e30 * iTime * 1e30) + fract(x + 2 / 3 * iTime); }
