uniform float iTime;
uniform sampler2D iChannel0;
out vec4 c;
#define PI 3.14159
const float NEAR = 1e-7;
float hash(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); }
float sphere(vec3 o, vec3 d, float r) {
    float b = dot(o, d), c = dot(o, o) - r * r, h = b * b - c;
    return h < 0.0 ? -1.0 : -b - sqrt(h);
}
void main() {
    vec2 p = gl_FragCoord.xy;
    float t = iTime * 2.0, s = 0.0;
    for (float x = 0.0; x < 1.0; x += 0.01)
        s += 1.0 - cos(x);
    if (p.x > 3.0)
        c = texture(iChannel0, p * 0.1);
    s += sin(p.x + 3.0 * (t - p.y)) + fract(PI * iTime) + mod(iTime, 2.0 * PI);
    s += sqrt(p.x) - sqrt(p.y) + acos(dot(normalize(p), vec2(1.0, 0.0))) + p.x * p.x - p.y * p.y;
    for (int i = 0; i < 64; i++) {
        float d = sphere(vec3(p, s), vec3(0.0, 0.0, 1.0), 1.0);
        if (d < NEAR)
            break;
        s += d;
    }
    c += vec4(s / p.x, sin(p.x) - sin(p.y), cos(s) - cos(t), hash(p));
}
