// A gradient with a knob of each kind.
#iUniform float bright = 0.5 in { 0.0, 2.0 }
#iUniform color3 tint = color3(1.0, 0.5, 0.0)
#iUniform int bands = 4 in { 1, 8 }
#define TURN 6.28
/// Returns the colour at a place.
vec3 paint(vec2 p) {
    return tint * bright * (0.5 + 0.5 * sin(TURN * p.x * float(bands) + iTime));
}
void mainImage(out vec4 c, in vec2 p) {
    c = vec4(paint(p / iResolution.xy), p.y / iResolution.y);
}
