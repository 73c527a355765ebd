//: --define OCTAVES=3
//: --define far=100.0
//: --define SHADE=x
//: --set tint=#ff8000
//: --set count=4
#define OCTAVES 7 // as many as there are
#define SHADE vec3(1) + \
    vec3(2)
#iUniform color3 tint = color3(1.0, 1.0, 1.0)
#iUniform int count = 2 in [1, 8]
#iUniform vec2 drift = 0.25
// #define OCTAVES 9
const float near = 0.1, far = 43.0;
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    const int half_of = OCTAVES / 2;
    fragColor = vec4(tint, 1.0);
}
