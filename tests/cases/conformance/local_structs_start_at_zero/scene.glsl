struct Inner { float d; vec2 k[2]; };
struct Surface { Inner i; mat3 turn; bool lit; ivec2 id; };
Surface surface(float d) {
    Surface s;
    s.i.d = d;
    return s;
}
struct { float a; vec2 b[2]; } unnamed;
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    Surface s = surface(3.0), t;
    struct Local { vec2 p; float q[3]; } l, many[3];
    t.i.k[1].y += 4.0;
    t.turn[2].z += 0.25;
    l.q[2] += 0.5;
    many[1].p.x += l.p.x;
    float other = s.i.k[1].y + s.turn[1].y + float(s.id.y) + (s.lit ? 1.0 : 0.0) + t.i.k[0].x + l.q[0] + many[2].q[1] + many[1].p.x;
    unnamed.b[1].x += other;
    fragColor = vec4(s.i.d, t.i.k[1].y + t.turn[2].z, l.q[2] + unnamed.b[1].x + unnamed.a, 1.0);
}
