//: pixel 0 255 0
#define mainImage(O,U) float a, b = 1.; for (int i; i < 4; i++) a += .25; O.rg = vec2(b - a, U.x > 0. ? a : 0.)
