// A scene that includes a file, which includes another one, twice.
#include "lib/waves.glsl" // waves
#include "lib/constants.glsl"

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = vec4(wave(fragCoord.x * PI));
}
