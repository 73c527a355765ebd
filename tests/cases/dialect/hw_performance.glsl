//: pixel 0 255 0
#ifndef HW_PERFORMANCE
uniform vec3 iResolution;
#endif
#if HW_PERFORMANCE == 0
#error the slow path
#endif
void mainImage(out vec4 o, in vec2 p) { o = vec4(0, iResolution.x > 0.5 ? 1 : 0, 0, 1); }
