//: cubemap
//: pixel 0 255 0
uniform vec2 iResolution;
void mainCubemap(out vec4 o, in vec2 p, in vec3 ro, in vec3 rd) { o = vec4(0, 1, 0, iResolution.x); }
