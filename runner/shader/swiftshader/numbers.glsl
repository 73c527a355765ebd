// Functions of numbers. `$` stands for the letters with which no name of the text begins, `$has(bit)` asks for a
// SwiftShaderPart, `precise` keeps the driver from reordering. A block of 2x2 pixels has one derivative, that of its
// pixel with even coordinates (`$across`, `$upwards`). Drivers may compute dFdxCoarse as dFdxFine, so that number is
// brought to the other pixels as the derivative of a number that is zero there. llvmpipe computes any number for a
// quotient by zero that it knows when it compiles; `$hidden` keeps a value from the compiler. So does `$alone` where
// SwiftOrder::compiler leaves out `precise`, which would reach what the author computes of arguments. Neighbours that do
// not take a branch have an influence on the derivatives in it, so functions choose their result without a branch.
// `$zero` has one, because of a choice without it LLVM always takes the number that is defined; it runs for zeros only.
// A pixel that does not take a branch reads 0 by an index in it. `$live` detects such pixels: llvmpipe writes nothing
// for them.
uniform int $mode, $filters;
bool $has(int part) { return ($mode & part) != 0; }
int $channels = 15;
int $filter() {
    int n = $filters & $channels, f = $filters >> 16 & $channels;
    return n != 0 && f != 0 || n == f ? -1 : n != 0 ? 1 : 0;
}
float $bits(int b) { return intBitsToFloat(b); }
int $bits(float v) { return floatBitsToInt(v); }
float $hidden(float v) { return $bits($bits(v) ^ ($mode >> 20)); }
int $hidden(int v) { return v ^ ($mode >> 20); }
uint $hidden(uint v) { return v ^ uint($mode >> 20); }
// Whether the driver's compiler knows the number: it computes with denormal numbers, llvmpipe draws with 0 instead.
// That is so without LLVM's optimisation (compile_for_few_drawings), which would also know a choice of two numbers.
bool $folded(int b) { return $bits($bits(b & 1 | 2) * 0.75) != 0; }
bool $known(float v) {
    bool folded = $folded($bits(v)), always = $folded($mode);
    return folded && !always;
}
// A compiler knows a vector or it does not, whatever it knows of its numbers.
vec2 $hidden(vec2 v) { return vec2($hidden(v.x), $hidden(v.y)); }
vec3 $hidden(vec3 v) { return vec3($hidden(v.xy), $hidden(v.z)); }
vec4 $hidden(vec4 v) { return vec4($hidden(v.xyz), $hidden(v.w)); }
bool $known(vec2 v) {
    bool x = $known(v.x), y = $known(v.y);
    return x && y;
}
bool $known(vec3 v) {
    bool xy = $known(v.xy), z = $known(v.z);
    return xy && z;
}
bool $known(vec4 v) {
    bool xyz = $known(v.xyz), w = $known(v.w);
    return xyz && w;
}
vec2 $whole(vec2 v) {
    vec2 h = $hidden(v);
    return $known(v) ? v : h;
}
vec3 $whole(vec3 v) {
    vec3 h = $hidden(v);
    return $known(v) ? v : h;
}
vec4 $whole(vec4 v) {
    vec4 h = $hidden(v);
    return $known(v) ? v : h;
}
float $fma(float a, float b, float c) {
    precise float p = $alone(a * b), r = p + c;
    return r;
}
float $wave(float x) {
    precise float s = x * x;
    return $fma($fma(74.4388885, s, -41.1693687), s, 6.28230858) * x;
}
float $sin(float x) {
    precise float t = $fma($alone(x), -0.159154937, 0.25);
    precise float z = 0.25 - abs(t - roundEven(t));
    float r = $wave(z), u = sin(x);
    bool known = $known(x);
    return $has(1) && !known ? r : u;
}
float $cos(float x) {
    precise float t = $alone(x) * 0.159154937, z = 0.25 - abs(t - roundEven(t));
    float r = $wave(z), u = cos(x);
    bool known = $known(x);
    return $has(1) && !known ? r : u;
}
float $tan(float x) {
    float r = $sin(x) / $cos(x), u = tan(x);
    return $has(1) ? r : u;
}
float $arc(float v) {
    float x = $alone(v);
    precise float s = x * x;
    precise float r = -0.0161657367 + s * 0.0028662257;
    r = 0.0429096138 + s * r;
    r = -0.0752896400 + s * r;
    r = 0.1065626393 + s * r;
    r = -0.1420889944 + s * r;
    r = 0.1999355085 + s * r;
    r = -0.3333314528 + s * r;
    r = x + x * (s * r);
    return r;
}
float $signed(float v, float like) { return $bits($bits(v) ^ ($bits(like) & 0x80000000)); }
float $atan(float x) {
    float a = abs(x), v = 1.0 / a, u = atan(x);
    bool far = a >= 1.0;
    v = far ? v : a;
    precise float r = $arc(v), c = 1.57079632 - r;
    r = far ? c : r;
    r = $signed(r, x);
    bool known = $known(x);
    return $has(2) && !known ? r : u;
}
float $atan(float y, float x) {
    bool s = y < 0.0;
    precise float t = s ? -3.14159265 : 0.0;
    float x0 = $signed(x, y), y0 = abs(y);
    bool q = x0 < 0.0;
    t += q ? 1.57079632 : 0.0;
    float n0 = -x0, x1 = q ? y0 : x0, y1 = q ? n0 : y0;
    bool o = y1 >= x1, whole = $has(y == 0.0 && x == 0.0 ? 16 : 2);
    float x2 = o ? y1 : x1, y2 = o ? x1 : y1, u = atan(y, x);
    bool endless = isinf(y2);
    precise float a = $arc(y2 / x2), n = -a, b = 1.57079632 - a;
    b = o ? b : a;
    b = x2 == 0.0 ? 0.0 : b;
    t += endless ? 0.785398163 : b;
    t = s && q && o && !endless ? n : t;
    bool known = $known(vec2(y, x));
    return whole && !known ? t : u;
}
// Functions of constants, which Chromium's compiler rounds correctly and llvmpipe's does not. No mode undoes them: the
// compiler would not know their value. `$exact_normalize` is among them: it divides by the length.
double $series(double v) {
    double t = v, s = v;
    for (int n = 0; n < 16; ++n) {
        t *= v * v * double(2 * n + 1) / double(2 * n + 2);
        s += t / double(2 * n + 3);
    }
    return s;
}
double $arc_sine(double a) {
    bool far = a > 0.5lf;
    double w = sqrt((1.0lf - a) * 0.5lf), v = far ? w : a, s = $series(v), c = 1.5707963267948966lf - 2.0lf * s;
    return far ? c : s;
}
double $arc_tangent(double a) {
    bool far = a > 1.0lf;
    double r = 1.0lf / a, v = far ? r : a, s = $arc_sine(v / sqrt(1.0lf + v * v)), c = 1.5707963267948966lf - s;
    return far ? c : s;
}
float $exact_asin(float x) { return $signed(float($arc_sine(double(abs(x)))), x); }
float $exact_acos(float x) {
    double a = double(abs(x)), s = 1.5707963267948966lf - $arc_sine(a), n = 3.141592653589793lf - s;
    return float(x < 0.0 ? n : s);
}
float $exact_atan(float x) { return $signed(float($arc_tangent(double(abs(x)))), x); }
float $exact_atan(float y, float x) {
    double a = $arc_tangent(abs(double(y) / double(x))), n = 3.141592653589793lf - a;
    return $signed(float(x < 0.0 ? n : a), y);
}
float $exact_tan(float x) {
    double v = x, t = v, s = v, u = 1.0lf, c = u;
    for (int n = 1; n < 24; ++n) {
        u *= -v * v / double((2 * n - 1) * (2 * n));
        t *= -v * v / double(2 * n * (2 * n + 1));
        c += u;
        s += t;
    }
    return float(s / c);
}
float $asin(float x) {
    float r = $exact_asin(x), u = asin(x);
    return $has(2) && abs(x) <= 1.0 ? r : u;
}
float $acos(float x) {
    float a = abs($alone(x)), u = acos(x);
    precise float r = 0.0742610 + a * -0.0187293;
    r = -0.2121144 + a * r;
    r = 1.5707288 + a * r;
    r = 1.57079632 - sqrt(1.0 - a) * r;
    precise float c = 1.57079632 - $signed(r, x);
    bool known = $known(x);
    return $has(2) && !known ? c : u;
}
float $raise(float x) {
    x = $alone(max(min(x, 128.0), -126.999992));
    int i = int(roundEven(x - 0.5));
    precise float f = x - float(i), r = 0.00187757669 * f + 0.00898933969;
    r = r * f + 0.0558263175;
    r = r * f + 0.240153611;
    r = r * f + 0.693153083;
    r = r * f + 1.0;
    return $bits((i + 127) << 23) * r;
}
float $lower(float x) {
    int b = $bits(x);
    float m = $bits((b & 0x7fffff) | 0x3f800000);
    precise float e = ($bits(((b & 0x7f800000) >> 8) | 0x3f800000) - 1.4960938) * 256.0;
    float u = $fma($fma(9.5428179e-2, m, 4.7779095e-1), m, 1.9782813e-1);
    float v = $fma($fma($fma(1.6618466e-2, m, 2.0350508e-1), m, 2.7382900e-1), m, 4.0496687e-2);
    e = e + (m - 1.0) * (u / v);
    e = b == 0x7f800000 ? x : e;
    return e;
}
float $exp2(float x) {
    float r = $raise(x), u = exp2(x);
    bool known = $known(x);
    return $has(4) && !known ? r : u;
}
float $exp(float x) {
    float r = $raise(1.44269504 * $alone(x)), u = exp(x);
    bool known = $known(x);
    return $has(4) && !known ? r : u;
}
float $log2(float x) {
    float r = $lower(x), u = log2(x);
    bool known = $known(x);
    return $has(x < 0.0 ? 16 : 4) && !known ? r : u;
}
float $log(float x) {
    float r = 6.93147181e-1 * $lower(x), u = log(x);
    bool known = $known(x);
    return $has(x < 0.0 ? 16 : 4) && !known ? r : u;
}
float $pow(float x, float y) {
    float r = $raise($lower(x) * $alone(y)), u = pow(x, y);
    bool known = $known(vec2(x, y));
    return $has(x < 0.0 || (x == 0.0 && y <= 0.0) ? 16 : 4) && !known ? r : u;
}
float $sinh(float x) {
    float r = ($raise(1.44269504 * x) - $raise(-1.44269504 * x)) * 0.5, u = sinh(x);
    return $has(4) ? r : u;
}
float $cosh(float x) {
    float r = ($raise(1.44269504 * x) + $raise(-1.44269504 * x)) * 0.5, u = cosh(x);
    return $has(4) ? r : u;
}
float $tanh(float x) {
    float a = $raise(1.44269504 * x), b = $raise(-1.44269504 * x), r = (a - b) / (a + b), u = tanh(x);
    return $has(4) ? r : u;
}
float $asinh(float x) {
    precise float s = x * x + 1.0, v = x + sqrt(s);
    float r = 6.93147181e-1 * $lower(v), u = asinh(x);
    return $has(4) ? r : u;
}
float $acosh(float x) {
    precise float v = x + sqrt(x + 1.0) * sqrt(x - 1.0);
    float r = 6.93147181e-1 * $lower(v), u = acosh(x);
    return $has(4) ? r : u;
}
float $atanh(float x) {
    float r = 6.93147181e-1 * $lower(float(double(1.0 + x) / double(1.0 - x))) * 0.5, u = atanh(x);
    return $has(4) ? r : u;
}
float $opposite(float a) { return a == 0.0 ? 0.5 : -a * $bits(0x7f800000); }
float $zero(float a, float b) {
    if ($has(16))
        b = $hidden(b);
    else
        return $has(8) ? float(double(a) / double(b)) : a / b;
    return $has(8) ? float(double(a) / double(b)) : a / b;
}
float $unless_zero(float q, float a, float b) {
    float z = 0.0, o = $opposite(a);
    bool none = b == 0.0, opposite = $has(0x40000);
    if (none) z = $zero(a, b);
    z = opposite ? o : z;
    return none ? z : q;
}
float $divide(float a, float b) {
    float s = float(double(a) / double(b)), q = a / b;
    precise float p = a * (1.0 / b);
    bool known = $known(b), both = $known(vec2(a, b));
    s = known && !both ? p : s;
    q = $has(8) ? s : q;
    return $unless_zero(q, a, b);
}
float $over(float a, float b) {
    precise float r = 1.0 / b, q = $alone(a) * r;
    float u = a / b;
    q = $has(8) ? q : u;
    return $unless_zero(q, a, b);
}
float $mod(float x, float y) {
    float h = $hidden(y), u = mod(x, y);
    precise float r = $alone(x) - h * floor($divide(x, h));
    return $has(y == 0.0 ? 16 : 8) ? r : u;
}
float $smoothstep(float a, float b, float x) {
    precise float w = $alone(x), v = $alone(a), d = w - v, e = $alone(b) - v;
    float t = clamp($divide(d, e), 0.0, 1.0);
    precise float r = t * t * (3.0 - 2.0 * t);
    float u = smoothstep(a, b, x);
    return $has(a < b ? 8 : 16) ? r : u;
}
bool $odd(float x, float y) { return max($bits(x) & 0x7fffffff, $bits(y) & 0x7fffffff) > 0x7f800000; }
float $min(float x, float y) {
    float u = min(x, y), r = x < y ? x : y;
    r = $odd(x, y) ? y : r;
    return $has(16) ? r : u;
}
float $max(float x, float y) {
    float u = max(x, y), r = x > y ? x : y;
    r = $odd(x, y) ? y : r;
    return $has(16) ? r : u;
}
float $clamp(float x, float a, float b) {
    float r = $min($max(x, a), b), u = clamp(x, a, b);
    return $has(16) ? r : u;
}
float $bound(float x, float a, float b) {
    float r = $clamp(x, a, b);
    return $has(16) && x <= a ? a : r;
}
vec3 $cross(vec3 a, vec3 b) {
    vec3 c = $alone(a), d = $alone(b);
    precise vec3 r = c.yzx * d.zxy - d.yzx * c.zxy;
    vec3 u = cross(a, b);
    return $has(8) ? r : u;
}
mat2 $inverse(mat2 m) {
    if (!$has(8)) return inverse(m);
    precise float d = 1.0 / (m[0][0] * m[1][1] - m[0][1] * m[1][0]);
    precise mat2 r = mat2(d * m[1][1], d * -m[0][1], d * -m[1][0], d * m[0][0]);
    return r;
}
float $volume(vec3 a, vec3 b, vec3 c) {
    precise float r = a.x * b.y * c.z + a.y * b.z * c.x + a.z * b.x * c.y - a.z * b.y * c.x -
                      a.y * b.x * c.z - a.x * b.z * c.y;
    return r;
}
float $determinant(mat2 m) {
    if (!$has(8)) return determinant(m);
    precise float r = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    return r;
}
float $determinant(mat3 m) { return $has(8) ? $volume(m[0], m[1], m[2]) : determinant(m); }
float $determinant(mat4 m) {
    if (!$has(8)) return determinant(m);
    precise vec4 v =
        m[0] * vec4($volume(m[1].yzw, m[2].yzw, m[3].yzw), $volume(m[1].xzw, m[2].xzw, m[3].xzw),
                    $volume(m[1].xyw, m[2].xyw, m[3].xyw), $volume(m[1].xyz, m[2].xyz, m[3].xyz));
    precise float r = v.x - v.y + v.z - v.w;
    return r;
}
float $minor(vec3 v, vec3 a, vec3 b) {
    precise vec3 m = v * (a.yxx * b.zzy - a.zzy * b.yxx);
    precise float r = m.x - m.y + m.z;
    return r;
}
vec4 $minors(vec4 v, vec4 a, vec4 b, float s) {
    return s * vec4($minor(v.yzw, a.yzw, b.yzw), -$minor(v.xzw, a.xzw, b.xzw), $minor(v.xyw, a.xyw, b.xyw),
                    -$minor(v.xyz, a.xyz, b.xyz));
}
mat3 $inverse(mat3 m) {
    if (!$has(8)) return inverse(m);
    precise float s = 1.0 / $determinant(m);
    return transpose(mat3(s * $cross(m[1], m[2]), s * $cross(m[2], m[0]), s * $cross(m[0], m[1])));
}
mat4 $inverse(mat4 m) {
    if (!$has(8)) return inverse(m);
    precise float s = 1.0 / $determinant(m);
    return transpose(mat4($minors(m[1], m[2], m[3], s), $minors(m[0], m[2], m[3], -s),
                          $minors(m[0], m[1], m[3], s), $minors(m[0], m[1], m[2], -s)));
}
int $modulo(int a, int b) {
    int d = b == 0 || b == -1 ? 1 : b, r = a - d * (a / d), s = r + b, u = a % b;
    r = r != 0 && (r < 0) != (b < 0) ? s : r;
    return $has(16) ? r : u;
}
uint $modulo(uint a, uint b) {
    uint r = a % 0xffffffffu, u = a % b;
    return $has(16) && b == 0u ? r : u;
}
int $quotient(int a, int b) {
    int n = -a, u = a / b;
    n = a == 0x80000000 ? 1 : n;
    return $has(16) && (b == 0 || b == -1) ? n : u;
}
uint $quotient(uint a, uint b) {
    uint r = a / 0xffffffffu, u = a / b;
    return $has(16) && b == 0u ? r : u;
}
uint $uint(float f) {
    uint u = uint(f);
    return $has(16) && !(f >= 0.0 && f < 4294967296.0) ? 0u : u;
}
int $place(int i, int n) {
    int c = clamp(i, 0, n - 1);
    return $has(16) ? c : i;
}
int $place(uint i, int n) {
    int c = int(min(i, uint(n - 1))), u = int(i);
    return $has(16) ? c : u;
}
float $fract(float x) {
    float r = min(x - floor(x), 0.99999994), u = fract(x);
    return $has(8) ? r : u;
}
float $mix(float x, float y, float a) {
    float b = $alone(x);
    precise float r = $alone(a) * ($alone(y) - b) + b;
    float u = mix(x, y, a);
    return $has(8) ? r : u;
}
float $mix(float x, float y, bool a) { return a ? y : x; }
bool $even(float at) { return (int(at) & 1) == 0; }
float $levels(float q, float by) {
    q *= q;
    return (float($bits(q)) - float(0x3f800000)) * by * 5.9604644775390625e-8;
}
float $across(float v) {
    v = dFdxFine(v);
    v = $even(gl_FragCoord.y) ? v : 0.0;
    return -dFdyFine(v);
}
float $upwards(float v) {
    v = dFdyFine(v);
    v = $even(gl_FragCoord.x) ? v : 0.0;
    return -dFdxFine(v);
}
float $dFdx(float v) {
    float r = $across(v), u = dFdx(v);
    return $has(128) ? r : u;
}
float $dFdy(float v) {
    float r = $upwards(v), u = dFdy(v);
    return $has(128) ? r : u;
}
// Zero is negative.
float $fwidth(float v) {
    float r = abs($across(v)) + abs($upwards(v)), u = fwidth(v);
    r = r == 0.0 ? intBitsToFloat(1 << 31) : r;
    return $has(128) ? r : u;
}
float $flag[2] = float[2](0.0, 0.0);
bool $live() {
    int a = $mode >> 20, b = $mode >> 21;
    $flag[a] = 1.0;
    float f = $flag[b];
    $flag[a] = 0.0;
    return f == 1.0;
}
bool $gone() {
    bool outside = $has(16), live = $live();
    return outside && !live;
}
float $kept(float v) { return $gone() ? 0.0 : v; }
int $kept(int v) { return $gone() ? 0 : v; }
uint $kept(uint v) { return $gone() ? 0u : v; }
float $dot(float a, float b) { return a * b; }
float $length(float v) { return abs(v); }
float $distance(float a, float b) { return abs(a - b); }
float $normalize(float v) { return normalize(v); }
float $reflect(float i, float n) { return reflect(i, n); }
float $refract(float i, float n, float e) { return refract(i, n, e); }
// Whether a texel's numbers are bytes (without `$filters`, or if a sampler may be of several textures, those that look
// so), and what lies between two mipmaps, whose numbers are multiplied by `by` and `other`.
bool $bytes(vec4 t) {
    bool near = all(lessThan(abs(t * 255.0 - roundEven(t * 255.0)), vec4(1e-3)));
    bool inside = all(lessThanEqual(abs(t - 0.5), vec4(0.5)));
    int n = $filters >> 4 & $channels, f = $filters >> 20 & $channels;
    return near && inside && (n != 0 || f == 0);
}
vec4 $between(vec4 a, float by, vec4 b, float other, float part) {
    precise vec4 r = (b - a) * part + a;
    return part == 0.0 || by == other ? r * by : mix(a * by, b * other, part);
}
