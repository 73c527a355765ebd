// Look-ups, for each SAMPLER: `@` is the type of coordinates, CORNERS the number of texels beside a place, THIRD what
// follows the first two coordinates of such a texel. Bytes are filtered as numbers up to 65280; a nearest one is
// found with 16 bits of the coordinate, cut off towards zero. Without `$filters`, a sampler that reads the same in
// the corners and in the middle of a texel is a nearest one. A bias is at most 15, so it does not change level
// -31.75, that of a coordinate which is the same in neighbouring pixels. llvmpipe's textureSize ignores that pixels
// may ask for different levels.
@ $via(int channels, @ p) {
    $channels = channels;
    return $alone(p);
}
vec4 $level(SAMPLER s, @ p, float l, out float by) {
    @ n = @(max(textureSize(s, 0) >> int(l), 1)), e = floor(p);
    precise @ at = (p - e) * n - 0.5;
    @ low = floor(at), f = at - low;
    vec4 t[CORNERS];
    bool bytes = true;
    for (int i = 0; i < CORNERS; ++i) {
        t[i] = textureLod(s, (low + @(i & 1, (i >> 1) & 1 THIRD) + 0.5) / n + e, l);
        bytes = bytes && $bytes(t[i]);
    }
    if (bytes)
        for (int i = 0; i < CORNERS; ++i) t[i] = roundEven(t[i] * 255.0) * 256.0;
    by = bytes ? 1.0 / 65280.0 : 1.0;
    for (int k = CORNERS / 2, a = 0; k > 0; k /= 2, ++a)
        for (int i = 0; i < k; ++i) {
            precise vec4 r = t[2 * i] + f[a] * (t[2 * i + 1] - t[2 * i]);
            t[i] = r;
        }
    return t[0];
}
vec4 $mips(SAMPLER s, @ p, float l) {
    int kind = $filter();
    l = clamp(l, 0.0, float(textureQueryLevels(s) - 1));
    float i = floor(l);
    vec4 own = textureLod(s, p, i);
    if (!$has(64)) return l == i ? own : mix(own, textureLod(s, p, i + 1.0), l - i);
    float by, other = 1.0;
    vec4 a = $level(s, p, i, by), b = l == i ? a : $level(s, p, i + 1.0, other);
    vec4 r = $between(a, by, b, other, l - i);
    i@ n = max(textureSize(s, 0) >> int(i), 1), q = i@(p * 65536.0);
    @ e = floor(p * @(n));
    vec4 middle = textureLod(s, (e + 0.5) / @(n), i);
    bool same = l == i && kind != 0;
    if (kind < 0)
        for (int i = 0; i < CORNERS; ++i)
            same = same && textureLod(s, (e + 0.1 + 0.8 * @(i & 1, (i >> 1) & 1 THIRD)) / @(n), l) == middle;
    vec4 found = textureLod(s, (@((q & 65535) * n >> 16) + 0.5) / @(n) + @(q >> 16), i);
    found = by < 1.0 ? roundEven(found * 255.0) * 256.0 * by : own;
    return same ? found : r;
}
vec4 $texture(SAMPLER s, @ p, float b) {
    if (!$has(96)) return texture(s, p, b);
    @ n = @(textureSize(s, 0)), x = $across(p) * n, y = $upwards(p) * n;
    return $mips(s, p, $levels(max(dot(x, x), dot(y, y)), 0.5) + clamp(b, -15.0, 15.0));
}
vec4 $texture(SAMPLER s, @ p) { return $has(96) ? $texture(s, p, 0.0) : texture(s, p); }
vec4 $textureLod(SAMPLER s, @ p, float l) { return $has(96) ? $mips(s, p, l) : textureLod(s, p, l); }
vec4 $textureGrad(SAMPLER s, @ p, @ x, @ y) {
    if (!$has(96)) return textureGrad(s, p, x, y);
    @ n = @(textureSize(s, 0)), u = x * n, v = y * n;
    return $mips(s, p, $levels(max(dot(u, u), dot(v, v)), 0.5));
}
