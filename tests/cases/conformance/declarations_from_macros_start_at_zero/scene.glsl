#define V vec2
#define DECLARE(type, name) type name
#define LIST(name, n) float name[n];
#define BOTH float left, right;
#define GIVE(f) void f(out float x) { x += 0.5; }
GIVE(half_of_one)
GIVE(another)
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    V v;
    DECLARE(float, a);
    DECLARE(int, n), k;
    LIST(list, 80) LIST(other, 3)
    BOTH
    float given = 8.0;
    v.y += 1.0;
    a += 1.0;
    n += 1;
    list[int(fragCoord.x) + 40] += 0.25;
    other[int(fragCoord.x)] += 0.5;
    half_of_one(given);
    fragColor = vec4(v.y + v.x, a + float(n) + float(k) + left + right,
                     list[int(fragCoord.x) + 40] + other[int(fragCoord.x)] + list[0] + given - 0.5, 1.0);
}
