#include "glsl/double/double_functions.hpp"

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

} // namespace tidemark::glsl
