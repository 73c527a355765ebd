// void mainImage(out vec4 fragColor, in vec2 fragCoord)
void mainImages(out vec4 c) { c = vec4(1.0); }
