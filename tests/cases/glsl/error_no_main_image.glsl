// void mainImage(out vec4 fragColor, in vec2 fragCoord)
void main() { gl_FragColor = vec4(1.0); }
