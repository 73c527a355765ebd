//: pixel 0 255 0
#define HAS(x) 1
float before() { return iTime; }
#if HAS(1)
uniform highp float iTime, iTimeDelta;
#endif
uniform vec2 iResolution;
uniform float iFrame, mine;
layout(location = 3) uniform vec4 iMouse;
#ifdef NOT_HERE
uniform int iDate;
#endif
void mainImage(out vec4 o, vec2 p) {
    o = vec4(iResolution.x * 0.0 + before() * 0.0 + iFrame * 0.0 + iTimeDelta * 0.0 + mine, 1.0, iDate.x * 0.0 + iMouse.x * 0.0, 1.0);
}
