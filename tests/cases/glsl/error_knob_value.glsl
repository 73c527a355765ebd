//: --set drift=1,2,3
#iUniform vec2 drift = 0.25
void mainImage(out vec4 fragColor, in vec2 fragCoord) {}
