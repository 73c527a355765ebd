#ifdef SOME_OTHER_HOST
#include "of_another_host.glsl"
#else
#include "lib/constants.glsl"
#endif
void mainImage(out vec4 fragColor, in vec2 fragCoord) { fragColor = vec4(PI); }
