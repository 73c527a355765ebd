//: sound
#define mainSound(t) mainSound(in int samp, float t)
vec2 mainSound(time) { float a, b; return vec2(sin(time + a), b); }
