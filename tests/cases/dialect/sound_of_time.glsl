//: sound
vec2 mainSound(in float time) { return vec2(sin(time)); }
