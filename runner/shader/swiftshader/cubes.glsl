// Cubes are filtered on a face with a border of the next faces' texels; a corner is the mean of its three
// texels. `$ray` and `$texel` look up the middle of a texel, whatever the driver's filter is.
vec3 $ray(int f, vec2 q, float m) {
    vec3 r = f < 2 ? vec3(m, -q.y, -q.x) : f < 4 ? vec3(q.x, m, q.y) : vec3(q.x, -q.y, m);
    return f == 3 ? r * vec3(1.0, -1.0, -1.0) : (f & 1) == 1 ? r * vec3(-1.0, 1.0, -1.0) : r;
}
vec4 $texel(samplerCube s, int f, vec2 i, float n, float l) {
    vec2 q = (2.0 * i + 1.0) / n - 1.0;
    return textureLod(
        s, $ray(f, clamp(q, -1.0, 1.0), any(greaterThan(abs(q), vec2(1.0))) ? 1.0 - 1.0 / n : 1.0), l);
}
vec4 $corner(samplerCube s, int f, vec2 i, float n, float l) {
    vec2 c = clamp(i, vec2(0.0), vec2(n - 1.0));
    vec4 x = $texel(s, f, vec2(i.x, c.y), n, l), y = $texel(s, f, vec2(c.x, i.y), n, l),
         z = $texel(s, f, c, n, l);
    if (i.x == c.x || i.y == c.y) return i.x == c.x ? y : x;
    precise vec4 m = (x + y + z) * 0.333333343;
    return $bytes(x) && $bytes(y) && $bytes(z) ? roundEven(m * 255.0) / 255.0 : m;
}
vec4 $level(samplerCube s, vec3 p, float l, int kind, out float by) {
    vec3 a = abs(p);
    float n = float(max(textureSize(s, 0).x >> int(l), 1));
    bool x = a.x > a.y && a.z <= a.x, y = a.y > a.z && a.x <= a.y, z = a.z > a.x && a.y <= a.z,
         low = x   ? p.x < 0.0
               : y ? p.y < 0.0
                   : z && p.z < 0.0;
    int f = (y ? 2 : z ? 4 : 0) + (low ? 1 : 0);
    vec2 u = vec2(x ? (low ? p.z : -p.z) : z && low ? -p.x : p.x, y ? (low ? -p.z : p.z) : -p.y);
    precise float m = 1.0 / max(max(a.x, a.y), a.z) * 0.5;
    precise vec2 q = u * m + 0.5, at = clamp(q, 0.0, 0.99999994) * n - 0.5;
    vec2 w = fract(at), e = floor(at + 0.5);
    vec4 t[4];
    bool bytes = true, one = kind != 0;
    vec4 middle = $texel(s, f, e, n, l);
    for (int i = 0; i < 4; ++i) {
        vec2 k = vec2(i & 1, i >> 1);
        t[i] = $corner(s, f, floor(at) + k, n, l);
        bytes = bytes && $bytes(t[i]);
        one = one &&
              (kind > 0 || textureLod(s, $ray(f, 2.0 * (e + 0.1 + 0.8 * k) / n - 1.0, 1.0), l) == middle);
    }
    if (one)
        for (int i = 0; i < 4; ++i) t[i] = middle;
    if (bytes)
        for (int i = 0; i < 4; ++i) t[i] = roundEven(t[i] * 255.0) * 256.0;
    by = bytes ? 1.0 / 65280.0 : 1.0;
    precise vec4 r = t[0] + w.x * (t[1] - t[0]), v = t[2] + w.x * (t[3] - t[2]), h = r + w.y * (v - r);
    return h;
}
vec4 $mips(samplerCube s, vec3 p, float l) {
    int kind = $filter();
    l = clamp(l, 0.0, float(textureQueryLevels(s) - 1));
    float i = floor(l), by, other = 1.0;
    if (!$has(64)) {
        vec4 a = textureLod(s, p, i);
        return l == i ? a : mix(a, textureLod(s, p, i + 1.0), l - i);
    }
    vec4 a = $level(s, p, i, kind, by), b = l == i ? a : $level(s, p, i + 1.0, kind, other);
    return $between(a, by, b, other, l - i);
}
float $spread(vec3 x, vec3 y) {
    x = abs(x), y = abs(y);
    return max(x.x + x.y + x.z - min(min(x.x, x.y), x.z), y.x + y.y + y.z - min(min(y.x, y.y), y.z));
}
vec4 $texture(samplerCube s, vec3 p, float b) {
    if (!$has(96)) return texture(s, p, b);
    vec3 u = p * (0.5 / max(max(abs(p.x), abs(p.y)), abs(p.z)));
    float q = $spread($across(u), $upwards(u)) * float(textureSize(s, 0).x);
    return $mips(s, p, $levels(q, 1.0) + clamp(b, -15.0, 15.0));
}
vec4 $texture(samplerCube s, vec3 p) { return $texture(s, p, 0.0); }
vec4 $textureLod(samplerCube s, vec3 p, float l) { return $has(96) ? $mips(s, p, l) : textureLod(s, p, l); }
vec4 $textureGrad(samplerCube s, vec3 p, vec3 x, vec3 y) {
    if (!$has(96)) return textureGrad(s, p, x, y);
    float m = 0.5 / max(max(abs(p.x), abs(p.y)), abs(p.z));
    return $mips(s, p, $levels($spread(x * m, y * m) * float(textureSize(s, 0).x), 1.0));
}
