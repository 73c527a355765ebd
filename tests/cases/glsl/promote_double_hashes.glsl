//: --double-hashes
float hash(float n) { return fract(sin(n) * 43758.5453); }
void mainImage(out vec4 c, in vec2 p) { c = vec4(hash(p.x)); }
