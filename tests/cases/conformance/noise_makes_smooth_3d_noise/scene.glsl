#iChannel0 "noise"
// Layers z and z + 1 of a 3-D lattice, as shaders written for a flipped noise picture look them up.
vec2 layers(vec2 cell, float z) {
    vec2 at = cell + vec2(37.0, 239.0) * z;
    return textureLod(iChannel0, (at + 0.5) / 256.0, 0.0).yx;
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 cell = floor(fragCoord);
    vec2 low = layers(cell, 4.0);
    vec2 high = layers(cell, 5.0);
    fragColor = vec4(abs(low.y - high.x) < 0.003, 0.0, 0.0, 1.0);
}
