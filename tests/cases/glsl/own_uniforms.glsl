//: --prologue
#version 300 es
#extension GL_OES_standard_derivatives : enable
precision highp float; uniform vec3 iResolution; uniform float iTime,
    iTimeDelta;
// uniform int iFrame;
#if 0
uniform vec4 iMouse;
#endif
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(fragCoord / iResolution.xy, iTime, iTimeDelta);
}
