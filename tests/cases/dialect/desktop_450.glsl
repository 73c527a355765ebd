//: pixel 0 255 0
#version 450 core
void mainImage(out vec4 o, vec2 p) { double d = 1.0lf; o = vec4(0, float(d), 0, 1); }
