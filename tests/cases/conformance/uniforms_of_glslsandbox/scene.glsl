#version 100
#ifdef GL_ES
precision mediump float;
#endif
#extension GL_OES_standard_derivatives : enable
uniform float time;
uniform vec2 mouse;
uniform vec2 resolution;
void main(void) {
    gl_FragColor = gl_FragCoord.x < 1.0 ? vec4(time, resolution, 1.0) : vec4(mouse, 0.0, 1.0);
}
