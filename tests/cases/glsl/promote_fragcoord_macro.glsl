//: --precision double
#define gl_FragCoord fragCoord
#define double float
double one = 1.;
void mainImage(out vec4 c, in vec2 fragCoord) { c = vec4(gl_FragCoord.xy, one, 1); }
