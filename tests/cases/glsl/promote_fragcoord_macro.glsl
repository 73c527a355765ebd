//: --precision double
#define gl_FragCoord fragCoord
float double_ = 1., dvec3 = 2.;
void mainImage(out vec4 c, in vec2 fragCoord) { c = vec4(gl_FragCoord.xy, dvec3, 1); }
