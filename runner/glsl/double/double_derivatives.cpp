#include "glsl/double/double_functions.hpp"

namespace tidemark::glsl {
namespace {

/// The hardware subtracts floats: the differences of a double's two float parts together lose next to
/// nothing, even if neighbouring pixels agree in all 24 bits. The result is NaN beyond the range of floats.
constexpr std::string_view k_dfdx = R"(
double tidemark_double_dFdx(double x) {
    precise double low = x - double(float(x));
    return double(dFdx(float(x))) + double(dFdx(float(low)));
}
)";
constexpr std::string_view k_dfdy = R"(
double tidemark_double_dFdy(double x) {
    precise double low = x - double(float(x));
    return double(dFdy(float(x))) + double(dFdy(float(low)));
}
)";
constexpr std::string_view k_fwidth = R"(
double tidemark_double_fwidth(double x) {
    return abs(tidemark_double_dFdx(x)) + abs(tidemark_double_dFdy(x));
}
)";

constexpr std::string_view k_radians = R"(
double tidemark_double_radians(double x) { return x * 0.017453292519943295lf; }
)";
constexpr std::string_view k_degrees = R"(
double tidemark_double_degrees(double x) { return x * 57.29577951308232lf; }
)";

} // namespace

std::vector<DoubleFunction> double_derivatives() {
    return {
        {"dFdx", 0, {}, k_dfdx},
        {"dFdy", 0, {}, k_dfdy},
        {"fwidth", 0, {"dFdx", "dFdy"}, k_fwidth},
        {"radians", 1.1, {}, k_radians},
        {"degrees", 1.1, {}, k_degrees},
    };
}

} // namespace tidemark::glsl
