//: --precision double
#define H(p) fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453)
float seed;
float rnd() { return fract(sin(seed++) * 43758.5453); }
float other(float s) { return fract(sin(seed += .1 * s) * 43758.5453); }
struct Cell { vec2 at[2]; };
void mainImage(out vec4 c, in vec2 p) {
    Cell cell;
    for (int i = 0; i < 2; i++)
        cell.at[i] = p * 2.;
    c = vec4(fract(cos(cell.at[1].x * 3. + length(p)) * 43758.5453), H(p + .5), rnd(), other(2.));
    c.x += fract(sin(p.x) * 2.);
}
