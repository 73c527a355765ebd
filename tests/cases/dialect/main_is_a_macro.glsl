//: pixel 0 255 0
#define main() mainImage(out vec4 fragColor, in vec2 fragCoord)
#define gl_FragCoord fragCoord
#define gl_FragColor fragColor
void main() { gl_FragColor = vec4(0.0, gl_FragCoord.x > 0.0 ? 1.0 : 0.0, 0.0, 1.0); }
