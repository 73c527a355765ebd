#ifdef SHADER_TOY
void mainImage(out vec4 c, in vec2 p) { c = vec4(iViewMatrix[0][0], iViewMatrix[3][2], iMouseButton.x, 1.0); }
#endif
