//: pixel 0 255 0 255
#version 300 es
precision highp float;
uniform vec2 resolution;
out vec4 colour;
void mainImage(out vec4 o, in vec2 p) { o = vec4(0, 1, 0, 0.25); }
void main(void) { mainImage(colour, gl_FragCoord.xy); }
