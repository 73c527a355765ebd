//: --precision double
//: --prologue
varying vec2 place;
void mainImage(out vec4 c, in vec2 p) { c = gl_FragCoord + vec4(place, 0, 0); }
