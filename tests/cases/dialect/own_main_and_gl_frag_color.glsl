//: pixel 0 255 0 255
#ifdef GL_ES
precision mediump float;
#endif
uniform float time;
void main() { gl_FragColor = vec4(0.0, 1.0, time * 0.0, 0.5); }
