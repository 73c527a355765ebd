#include "glsl/double/double_functions.hpp"

namespace tidemark::glsl {
namespace {

/// Computes sinh x for |x| <= 1, with an error below 2^-61.8.
constexpr std::string_view k_small_sinh = R"(
double tidemark_small_sinh(double x) {
    precise double z = x * x;
    precise double p = 0.16666666666666669lf + z * (0.008333333333332912lf + z * (0.0001984126984159341lf
                     + z * (2.755731910675605e-06lf + z * (2.5052130998960056e-08lf
                     + z * (1.6056659138049915e-10lf + z * 7.776601355168273e-13lf)))));
    return x + x * (z * p);
}
)";

/// Computes sinh from e^|x|/2, which is finite as long as the result is.
constexpr std::string_view k_sinh = R"(
double tidemark_double_sinh(double x) {
    double e = tidemark_exp_scaled(abs(x), -1.0lf);
    precise double large = e - 0.25lf / e;
    return abs(x) < 1.0lf ? tidemark_small_sinh(x) : x < 0.0lf ? -large : large;
}
)";

constexpr std::string_view k_cosh = R"(
double tidemark_double_cosh(double x) {
    double e = tidemark_exp_scaled(abs(x), -1.0lf);
    return e + 0.25lf / e;
}
)";

constexpr std::string_view k_tanh = R"(
double tidemark_double_tanh(double x) {
    double s = tidemark_small_sinh(x);
    precise double large = 1.0lf - 1.0lf / (tidemark_exp_scaled(2.0lf * abs(x), -1.0lf) + 0.5lf);
    return abs(x) < 0.6lf ? s / sqrt(1.0lf + s * s) : x < 0.0lf ? -large : large;
}
)";

/// Computes log(1 + x) and adds back the part that 1 + x loses.
constexpr std::string_view k_log1p = R"(
double tidemark_log1p(double x) {
    precise double u = 1.0lf + x;
    precise double lost = ((u - 1.0lf) - x) / u;
    return u == 1.0lf ? x : tidemark_double_log(u) - (u <= 1e300lf ? lost : 0.0lf);
}
)";

constexpr std::string_view k_asinh = R"(
double tidemark_double_asinh(double x) {
    double a = abs(x);
    bool huge = a > 1e17lf;
    double b = huge ? 1.0lf : a;
    precise double z = b * b;
    double l = tidemark_log1p(huge ? a : b + z / (1.0lf + sqrt(z + 1.0lf)));
    double r = huge ? l + 0.6931471805599453lf : l;
    return x < 0.0lf ? -r : r;
}
)";

constexpr std::string_view k_acosh = R"(
double tidemark_double_acosh(double x) {
    bool huge = x > 1e17lf;
    precise double t = huge ? x : x - 1.0lf;
    double l = tidemark_log1p(huge ? x : t + sqrt(2.0lf * t + t * t));
    return huge ? l + 0.6931471805599453lf : l;
}
)";

constexpr std::string_view k_atanh = R"(
double tidemark_double_atanh(double x) {
    double a = abs(x);
    double r = 0.5lf * tidemark_log1p(2.0lf * a / (1.0lf - a));
    return x < 0.0lf ? -r : r;
}
)";

} // namespace

std::vector<DoubleFunction> double_hyperbolics() {
    return {
        {"small_sinh", 0, {}, k_small_sinh},   {"sinh", 1.8, {"exp_scaled", "small_sinh"}, k_sinh},
        {"cosh", 1.5, {"exp_scaled"}, k_cosh}, {"tanh", 2.5, {"exp_scaled", "small_sinh"}, k_tanh},
        {"log1p", 0, {"log"}, k_log1p},        {"asinh", 1.9, {"log1p"}, k_asinh},
        {"acosh", 1.9, {"log1p"}, k_acosh},    {"atanh", 2.5, {"log1p"}, k_atanh},
    };
}

} // namespace tidemark::glsl
