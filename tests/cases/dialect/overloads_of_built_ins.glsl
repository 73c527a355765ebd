//: pixel 0 255 0
float determinant(vec2 a) { return a.x; }
vec2 mod(ivec2 a, int b) { return vec2(a % b); }
float pow(float a, int n) { return a; }
float unity = iTime * 0.0 + 1.0;
void mainImage(out vec4 o, vec2 p) { o = vec4(mod(ivec2(2), 2).x, determinant(vec2(1)) * pow(1.0, 2) * unity, 0, 1); }
