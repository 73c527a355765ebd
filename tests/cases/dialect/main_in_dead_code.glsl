//: pixel 0 255 0
#if 0
void main() { gl_FragColor = vec4(1); }
#endif
/* void main() {} */
#ifdef STANDALONE
void main() { mainImage(gl_FragColor, gl_FragCoord.xy); }
#endif
void mainImage(out vec4 o, in vec2 p) { o = vec4(0, 1, 0, 1); }
