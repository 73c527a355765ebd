// Functions of vectors, once for each type `@`.
@ $kept(@ v) {
    @ none = @(0.0);
    return $gone() ? none : v;
}
@ $mix(@ x, @ y, @ a) {
    @ b = $alone(x);
    precise @ r = $alone(a) * ($alone(y) - b) + b;
    @ u = mix(x, y, a);
    return $has(8) ? r : u;
}
@ $divide(@ a, float b) { return $divide(a, @(b)); }
@ $divide(float a, @ b) { return $divide(@(a), b); }
@ $min(@ a, float b) { return $min(a, @(b)); }
@ $max(@ a, float b) { return $max(a, @(b)); }
@ $clamp(@ x, float a, float b) { return $clamp(x, @(a), @(b)); }
@ $bound(@ x, @ a, @ b) {
    @ r = $clamp(x, a, b);
    return $has(16) && all(lessThanEqual(x, a)) ? a : r;
}
@ $bound(@ x, float a, float b) { return $bound(x, @(a), @(b)); }
@ $over(@ a, float b) {
    precise float r = 1.0 / b;
    precise @ q = $alone(a) * r;
    @ u = a / b, z = $divide(a, b);
    q = $has(8) ? q : u;
    return b == 0.0 ? z : q;
}
@ $over(@ a, @ b) {
    bool none = any(equal(b, @(0.0)));
    precise @ r = 1.0 / b, q = $alone(a) * r;
    @ u = a / b, z = $divide(a, b);
    q = $has(8) ? q : u;
    return none ? z : q;
}
@ $over(float a, @ b) { return $over(@(a), b); }
@ $mod(@ a, float b) { return $mod(a, @(b)); }
@ $smoothstep(float a, float b, @ x) { return $smoothstep(@(a), @(b), x); }
@ $mix(@ x, @ y, float a) {
    @ r = $mix(x, y, @(a)), u = mix(x, y, a);
    return $has(8) ? r : u;
}
float $length(@ v) {
    float r = sqrt($dot(v, v)), u = length(v);
    return $has(8) ? r : u;
}
float $distance(@ a, @ b) {
    precise @ d = $alone(a) - $alone(b), s = d * d;
    precise float r = s[0];
    for (int i = 1; i < s.length(); ++i) r = $alone(r + s[i]);
    r = sqrt(r);
    float u = distance(a, b);
    return $has(8) ? r : u;
}
@ $normalize(@ v) {
    @ r = (1.0 / sqrt($dot(v, v))) * $alone(v), u = normalize(v);
    return $has(8) ? r : u;
}
@ $exact_normalize(@ v) {
    precise float s = v[0] * v[0];
    for (int i = 1; i < v.length(); ++i) s += v[i] * v[i];
    double n = double(sqrt(s));
    for (int i = 0; i < v.length(); ++i) v[i] = float(double(v[i]) / n);
    return v;
}
u@ $u@(@ f) {
    u@ r;
    for (int i = 0; i < f.length(); ++i) r[i] = $uint(f[i]);
    return r;
}
@ $reflect(@ i, @ n) {
    precise @ r = $alone(i) - (2.0 * $dot(i, n)) * $alone(n);
    @ u = reflect(i, n);
    return $has(8) ? r : u;
}
@ $refract(@ i, @ n, float e) {
    float d = $dot(i, n), a = $alone(e);
    precise float k = 1.0 - a * a * (1.0 - d * d), t = a * d + sqrt(k);
    precise @ r = a * $alone(i) - t * $alone(n);
    @ u = refract(i, n, e), none = @(0.0);
    r = k >= 0.0 ? r : none;
    return $has(8) ? r : u;
}
