#include "shader/double_functions.hpp"

namespace tidemark::glsl {
namespace {

/// Reduces x - n pi/2 = y + tail with |y| <= pi/4. pi/2 is in parts of 33, 33 and 53 bits and n in two of 20,
/// so that the products are exact up to 1e12. Beyond that the remainder is computed as for floats: useless,
/// but bounded.
constexpr std::string_view k_angle = R"(
struct tidemark_Angle { double y; double tail; int quadrant; };
tidemark_Angle tidemark_angle(double x) {
    precise double far = clamp(x - 6.283185307179586lf * floor(x * 0.15915494309189535lf), 0.0lf, 6.3lf);
    double near = abs(x) <= 1e12lf ? x : far;
    precise double n = roundEven(near * 0.6366197723675814lf);
    precise double high = roundEven(n * 9.5367431640625e-07lf) * 1048576.0lf;
    precise double low = n - high;
    precise double t = ((near - high * 1.5707963267341256lf) - low * 1.5707963267341256lf)
                     - high * 6.077100506303966e-11lf;
    precise double w = low * 6.077100506303966e-11lf;
    precise double r = t - w;
    precise double v = n * 2.0222662487959506e-21lf - ((t - r) - w);
    precise double y = r - v;
    precise double tail = (r - y) - v;
    return tidemark_Angle(y, tail, int(low) & 3);
}
)";

/// Computes (sin, cos) of an angle in [-pi/4, pi/4]; the polynomials' errors are below 2^-57.9 and 2^-63.9.
constexpr std::string_view k_sin_cos = R"(
dvec2 tidemark_sin_cos(tidemark_Angle a) {
    precise double z = a.y * a.y;
    precise double v = z * a.y;
    precise double s = 0.00833333333332184lf + z * (-0.00019841269829358541lf + z * (2.7557313538526334e-06lf
                     + z * (-2.505073439242268e-08lf + z * 1.5895433544929882e-10lf)));
    precise double sine = a.y - ((z * (0.5lf * a.tail - v * s) - a.tail) + v * 0.1666666666666663lf);
    precise double c = 0.041666666666666595lf + z * (-0.001388888888887334lf + z * (2.4801587288999616e-05lf
                     + z * (-2.755731421606095e-07lf + z * (2.087570523233725e-09lf
                     - z * 1.1358739381498488e-11lf))));
    precise double h = 0.5lf * z;
    precise double u = 1.0lf - h;
    precise double cosine = u + (((1.0lf - u) - h) + (z * z * c - a.y * a.tail));
    return dvec2(sine, cosine);
}
double tidemark_finite(double x, double y) {
    return abs(x) <= 1.7976931348623157e+308lf ? y : packDouble2x32(uvec2(0u, 0x7ff80000u));
}
)";

constexpr std::string_view k_sin = R"(
double tidemark_double_sin(double x) {
    tidemark_Angle a = tidemark_angle(x);
    dvec2 v = tidemark_sin_cos(a);
    double r = (a.quadrant & 1) == 0 ? v.x : v.y;
    return tidemark_finite(x, (a.quadrant & 2) == 0 ? r : -r);
}
)";

constexpr std::string_view k_cos = R"(
double tidemark_double_cos(double x) {
    tidemark_Angle a = tidemark_angle(x);
    dvec2 v = tidemark_sin_cos(a);
    double r = (a.quadrant & 1) == 0 ? v.y : v.x;
    return tidemark_finite(x, ((a.quadrant + 1) & 2) == 0 ? r : -r);
}
)";

constexpr std::string_view k_tan = R"(
double tidemark_double_tan(double x) {
    tidemark_Angle a = tidemark_angle(x);
    dvec2 v = tidemark_sin_cos(a);
    dvec2 q = (a.quadrant & 1) == 0 ? v : dvec2(-v.y, v.x);
    return tidemark_finite(x, q.x / q.y);
}
)";

/// Keeps the upper half: 21 bits of the mantissa.
constexpr std::string_view k_high = R"(
double tidemark_high(double x) {
    return packDouble2x32(uvec2(0u, unpackDouble2x32(x).y));
}
)";

/// Computes |x| <= 1/2 directly; beyond, asin x = pi/2 - 2 asin sqrt((1 - |x|)/2) with the root in two parts.
/// The polynomial's error is below 2^-57.4. Returns (small, root, its two parts' high and low, z P(z)).
constexpr std::string_view k_arc = R"(
struct tidemark_Arc { bool small; double s; double high; double low; double p; };
tidemark_Arc tidemark_arc(double x) {
    double a = abs(x);
    bool small = a <= 0.5lf;
    precise double z = small ? a * a : (1.0lf - a) * 0.5lf;
    precise double s = small ? a : sqrt(z);
    precise double high = tidemark_high(s);
    precise double low = s > 0.0lf ? (z - high * high) / (s + high) : 0.0lf;
    precise double p = 0.16666666666666669lf + z * (0.07499999999998433lf + z * (0.04464285714635543lf
                     + z * (0.030381944138531247lf + z * (0.02237217294214989lf + z * (0.017352392720869973lf
                     + z * (0.013971212973552933lf + z * (0.011479177415184906lf + z * (0.01032281435018578lf
                     + z * (0.005457506718640358lf + z * (0.01740087944269402lf + z * (-0.014851887071247204lf
                     + z * 0.028757851367421566lf)))))))))));
    return tidemark_Arc(small, s, high, low, z * p);
}
)";

constexpr std::string_view k_asin = R"(
double tidemark_double_asin(double x) {
    tidemark_Arc a = tidemark_arc(x);
    precise double large = 0.7853981633974483lf
        - ((2.0lf * a.s * a.p - (6.123233995736766e-17lf - 2.0lf * a.low)) - (0.7853981633974483lf - 2.0lf * a.high));
    precise double r = a.small ? a.s + a.s * a.p : large;
    return x < 0.0lf ? -r : r;
}
)";

constexpr std::string_view k_acos = R"(
double tidemark_double_acos(double x) {
    tidemark_Arc a = tidemark_arc(x);
    precise double small = 1.5707963267948966lf - (x - (6.123233995736766e-17lf - x * a.p));
    precise double right = 2.0lf * (a.high + (a.p * a.s + a.low));
    precise double left = 3.141592653589793lf - 2.0lf * (a.s + (a.p * a.s - 6.123233995736766e-17lf));
    return a.small ? small : x < 0.0lf ? left : right;
}
)";

/// Computes atan of a number that is not negative: atan b + atan((x - b)/(1 + b x)), b one of 0, 1/2, 1, 3/2
/// and infinity. The polynomial's error is below 2^-57.7.
constexpr std::string_view k_positive_atan = R"(
double tidemark_positive_atan(double x) {
    bool steep = x >= 2.4375lf;
    double b = x < 0.4375lf ? 0.0lf : x < 0.6875lf ? 0.5lf : x < 1.1875lf ? 1.0lf : 1.5lf;
    dvec2 base = steep ? dvec2(1.5707963267948966lf, 6.123233995736766e-17lf)
               : x < 0.4375lf ? dvec2(0.0lf)
               : x < 0.6875lf ? dvec2(0.4636476090008061lf, 2.2698777452961687e-17lf)
               : x < 1.1875lf ? dvec2(0.7853981633974483lf, 3.061616997868383e-17lf)
                              : dvec2(0.982793723247329lf, 1.3903311031230998e-17lf);
    precise double t = (steep ? -1.0lf : x - b) / (steep ? x : 1.0lf + b * x);
    precise double z = t * t;
    precise double p = -0.3333333333333292lf + z * (0.19999999999873716lf + z * (-0.14285714272261993lf
                     + z * (0.11111110394982496lf + z * (-0.09090886871541665lf + z * (0.07691872151766414lf
                     + z * (-0.0666103300121887lf + z * (0.05833315414571995lf + z * (-0.04975875732279554lf
                     + z * (0.03650930978302727lf - z * 0.01626448154170992lf)))))))));
    precise double r = base.x + (t + (t * z * p + base.y));
    return r;
}
)";

/// Computes the angle of (x, y). As in C, two infinities are a diagonal, and two zeros follow the signs.
constexpr std::string_view k_atan = R"(
double tidemark_double_atan(double y) {
    double r = tidemark_positive_atan(abs(y));
    return y < 0.0lf ? -r : r;
}
double tidemark_double_atan(double y, double x) {
    double a = abs(x);
    double b = abs(y);
    double r = tidemark_positive_atan(b == a ? (isnan(a) ? a : 1.0lf) : b / a);
    r = b == 0.0lf ? 0.0lf : r;
    precise double far = 3.141592653589793lf - (r - 1.2246467991473532e-16lf);
    r = (unpackDouble2x32(x).y >> 31) == 0u ? r : far;
    r = isnan(x) || isnan(y) ? packDouble2x32(uvec2(0u, 0x7ff80000u)) : r;
    return (unpackDouble2x32(y).y >> 31) == 0u ? r : -r;
}
)";

} // namespace

std::vector<DoubleFunction> double_trigonometry() {
    return {
        {"angle", 0, {}, k_angle},
        {"sin_cos", 0, {"angle"}, k_sin_cos},
        {"sin", 0.8, {"sin_cos"}, k_sin}, // |x| <= 1e12
        {"cos", 0.8, {"sin_cos"}, k_cos}, // |x| <= 1e12
        {"tan", 2.1, {"sin_cos"}, k_tan}, // |x| <= 1e12
        {"high", 0, {}, k_high},
        {"arc", 0, {"high"}, k_arc},
        {"asin", 0.9, {"arc"}, k_asin},
        {"acos", 0.9, {"arc"}, k_acos},
        {"positive_atan", 0, {}, k_positive_atan},
        {"atan", 1.5, {"positive_atan"}, k_atan}, // with two arguments; 0.8 with one
    };
}

namespace {

/// Multiplies y by 2^k in two factors, for results from below the normal numbers up to infinity.
constexpr std::string_view k_scale = R"(
double tidemark_scale(double y, double k) {
    int n = int(k);
    int m = n >> 1;
    double first = packDouble2x32(uvec2(0u, uint(m + 1023) << 20));
    double second = packDouble2x32(uvec2(0u, uint(n - m + 1023) << 20));
    return y * first * second;
}
)";

/// Computes e^x 2^k for x = high - low, |x| <= ln 2 / 2: e^x = 1 + x + x c/(2 - c) with c = x + 2 - x
/// coth(x/2), in which all terms but x are even. Error below 2^-59.6.
constexpr std::string_view k_exp_kernel = R"(
double tidemark_exp_kernel(double high, double low, double k) {
    precise double x = high - low;
    precise double z = x * x;
    precise double c = x - z * (0.1666666666666666lf + z * (-0.0027777777777564404lf + z * (6.613756471622828e-05lf
                     + z * (-1.6534060033836456e-06lf + z * 4.1437662804024295e-08lf))));
    precise double a = 1.0lf + high;
    precise double lost = high - (a - 1.0lf);
    precise double y = a + (lost + ((x * c) / (2.0lf - c) - low));
    return tidemark_scale(y, k);
}
)";

/// Computes e^x 2^shift. ln 2 is in two parts, the first of 32 bits.
constexpr std::string_view k_exp_scaled = R"(
double tidemark_exp_scaled(double x, double shift) {
    double a = clamp(x, -746.0lf, 711.0lf);
    double k = roundEven(a * 1.4426950408889634lf);
    precise double high = a - k * 0.6931471803691238lf;
    precise double low = k * 1.9082149292705877e-10lf;
    return isnan(x) ? x : tidemark_exp_kernel(high, low, k + shift);
}
)";

constexpr std::string_view k_exp = R"(
double tidemark_double_exp(double x) {
    return tidemark_exp_scaled(x, 0.0lf);
}
)";

/// Computes 2^(high + low), saturating; low is small relative to high.
constexpr std::string_view k_exp2_sum = R"(
double tidemark_exp2_sum(double high, double low) {
    bool far = abs(high) > 1100.0lf;
    precise double a = far ? (high > 0.0lf ? 1100.0lf : -1100.0lf) : high;
    precise double b = far ? 0.0lf : low;
    double k = roundEven(a + b);
    precise double p = a - k;
    precise double r = p + b;
    precise double t = tidemark_high(r);
    precise double u = t * 0.6931471803691238lf;
    precise double v = (b - (t - p)) * 0.6931471805599453lf + t * 1.9082149292705877e-10lf;
    return tidemark_exp_kernel(u, -v, k);
}
)";

constexpr std::string_view k_exp2 = R"(
double tidemark_double_exp2(double x) {
    return isnan(x) ? x : tidemark_exp2_sum(x, 0.0lf);
}
)";

/// Splits x = m 2^k with m in [sqrt 1/2, sqrt 2).
constexpr std::string_view k_mantissa = R"(
dvec2 tidemark_mantissa(double x) {
    bool tiny = x < 2.2250738585072014e-308lf;
    uvec2 bits = unpackDouble2x32(tiny ? x * 18014398509481984.0lf : x);
    uint high = bits.y + 0x95f62u;
    double m = packDouble2x32(uvec2(bits.x, (high & 0xfffffu) + 0x3fe6a09eu));
    return dvec2(m, double(int(high >> 20) - (tiny ? 1077 : 1023)));
}
double tidemark_log_result(double x, double y) {
    return x > 0.0lf ? (x <= 1.7976931348623157e+308lf ? y : x)
                     : packDouble2x32(uvec2(0u, x == 0.0lf ? 0xfff00000u : 0x7ff80000u));
}
)";

/// With s = f/(2 + f): log(1 + f) = f - h + s (h + R(s)), h = f^2/2. Error below 2^-59.5. Returns (f, h, s (h
/// + R)).
constexpr std::string_view k_log_kernel = R"(
dvec3 tidemark_log_kernel(double m) {
    precise double f = m - 1.0lf;
    precise double s = f / (2.0lf + f);
    precise double z = s * s;
    precise double r = z * (0.6666666666666734lf + z * (0.39999999999416413lf + z * (0.2857142874211211lf
                     + z * (0.2222219859382153lf + z * (0.18183563548268275lf + z * (0.15314064485414042lf
                     + z * 0.14795859715948273lf))))));
    precise double h = 0.5lf * f * f;
    precise double rest = s * (h + r);
    return dvec3(f, h, rest);
}
)";

constexpr std::string_view k_log = R"(
double tidemark_double_log(double x) {
    dvec2 mk = tidemark_mantissa(x);
    dvec3 v = tidemark_log_kernel(mk.x);
    precise double y = mk.y * 0.6931471803691238lf
                     - ((v.y - (v.z + mk.y * 1.9082149292705877e-10lf)) - v.x);
    return tidemark_log_result(x, y);
}
)";

constexpr std::string_view k_log2 = R"(
double tidemark_double_log2(double x) {
    dvec2 mk = tidemark_mantissa(x);
    dvec3 v = tidemark_log_kernel(mk.x);
    precise double high = tidemark_high(v.x - v.y);
    precise double low = (v.x - high) - v.y + v.z;
    precise double main = high * 1.4426946640014648lf;
    precise double rest = (low + high) * 3.768874985636099e-07lf + low * 1.4426946640014648lf;
    precise double sum = mk.y + main;
    precise double y = (rest + ((mk.y - sum) + main)) + sum;
    return tidemark_log_result(x, y);
}
)";

/// Computes 2^(y log2 x) with log2 x in two parts. x = m 2^k with m in [sqrt 3/4, sqrt 3); with b the nearer
/// of 1 and 3/2, s = (m - b)/(m + b) stays below 0.102: 3 atanh(s) = s (3 + s^2 + s^4 W(s^2)), with W to
/// 2^-70 of the whole. Over a wider range the rounding of s^4 W, times an exponent of 1000, would show. A
/// negative x has a power where floats happen to have one, because drivers compute x^1, x^2 and x^4 as
/// products.
constexpr std::string_view k_pow = R"(
double tidemark_pow_positive(double x, double y) {
    dvec2 mk = tidemark_mantissa(x);
    mk = mk.x < 0.8660254037844386lf ? dvec2(2.0lf * mk.x, mk.y - 1.0lf) : mk;
    bool upper = mk.x > 1.224744871391589lf;
    double b = upper ? 1.5lf : 1.0lf;
    double b_high = upper ? 0.5849624872207642lf : 0.0lf;
    double b_low = upper ? 1.350039202129749e-08lf : 0.0lf;
    precise double f = mk.x - b;
    precise double d = mk.x + b;
    precise double inverse_d = 1.0lf / d;
    precise double s = f * inverse_d;
    precise double s_high = tidemark_high(s);
    precise double d_high = tidemark_high(d);
    precise double d_low = mk.x - (d_high - b);
    precise double s_low = ((f - s_high * d_high) - s_high * d_low) * inverse_d;
    precise double z = s * s;
    precise double r = z * z * (0.6lf + z * (0.4285714285714264lf + z * (0.33333333333679027lf
                     + z * (0.2727272706971641lf + z * (0.23076979806525474lf + z * (0.19991873485266534lf
                     + z * 0.1822238530987954lf))))))
                     + s_low * (s_high + s);
    precise double q = s_high * s_high;
    precise double t_high = tidemark_high(3.0lf + q + r);
    precise double t_low = r - ((t_high - 3.0lf) - q);
    precise double u = s_high * t_high;
    precise double v = s_low * t_high + t_low * s;
    precise double p_high = tidemark_high(u + v);
    precise double p_low = v - (p_high - u);
    precise double l_high = p_high * 0.9617962837219238lf;
    precise double l_low = p_high * 4.102040517767816e-07lf + p_low * 0.9617966939259756lf + b_low;
    precise double log_high = tidemark_high(l_high + l_low + b_high + mk.y);
    precise double log_low = l_low - (((log_high - mk.y) - b_high) - l_high);
    precise double a = clamp(y, -1e300lf, 1e300lf);
    precise double a_high = tidemark_high(a);
    precise double low = (a - a_high) * log_high + a * log_low;
    precise double high = a_high * log_high;
    return tidemark_exp2_sum(high, low);
}
double tidemark_double_pow(double x, double y) {
    double a = y == 4.0lf ? abs(x) : x;
    double nan = packDouble2x32(uvec2(0u, 0x7ff80000u));
    double infinity = packDouble2x32(uvec2(0u, 0x7ff00000u));
    double r = a > 0.0lf && a < infinity ? tidemark_pow_positive(a, y)
             : a < 0.0lf || isnan(x) ? nan : (a == 0.0lf) == (y > 0.0lf) ? 0.0lf : infinity;
    r = y == 1.0lf ? x : y == 2.0lf ? x * x : r;
    return isnan(y) ? y : y == 0.0lf ? 1.0lf : r;
}
)";

} // namespace

std::vector<DoubleFunction> double_exponentials() {
    return {
        {"scale", 0, {}, k_scale},
        {"exp_kernel", 0, {"scale"}, k_exp_kernel},
        {"exp_scaled", 0, {"exp_kernel"}, k_exp_scaled},
        {"exp", 0.8, {"exp_scaled"}, k_exp},
        {"exp2_sum", 0, {"high", "exp_kernel"}, k_exp2_sum},
        {"exp2", 0.8, {"exp2_sum"}, k_exp2},
        {"mantissa", 0, {}, k_mantissa},
        {"log_kernel", 0, {}, k_log_kernel},
        {"log", 0.9, {"mantissa", "log_kernel"}, k_log},
        {"log2", 0.8, {"high", "mantissa", "log_kernel"}, k_log2},
        {"pow", 0.7, {"high", "mantissa", "exp2_sum"}, k_pow},
    };
}

} // namespace tidemark::glsl
