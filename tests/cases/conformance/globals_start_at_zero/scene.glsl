struct S { float a; int b[2]; };
float g;
vec3 h[3];
S s, t[2];
int large[300];
mat4 m;
bool flag;
struct { vec2 p; } unnamed;
void raise() {
    g += 1.0;
    h[1].x += 2.0;
    s.a += 3.0;
    s.b[1] += 4;
    t[1].b[0] += 1;
    large[299] += 3;
    m[3].w += 1.0;
    unnamed.p.y += 1.0;
}
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    raise();
    int at = int(fragCoord.x);
    fragColor = vec4(g + h[1].x + s.a + h[0].x, float(s.b[1] + t[1].b[0] + large[299] + large[at] + s.b[at] * (1 - at)),
                     m[3].w + unnamed.p.y + unnamed.p.x + (flag ? 1.0 : 0.0), 1.0);
}
