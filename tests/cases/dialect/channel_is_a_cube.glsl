//: pixel 0 255 0
void mainImage(out vec4 o, vec2 p) { o = vec4(0.0 * texture(iChannel1, vec3(p, 1)).x, 1, 0.0 * texture(iChannel0, p).x, 1); }
