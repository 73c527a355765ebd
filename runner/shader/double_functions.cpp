#include "shader/double_functions.hpp"

#include "shader/builtin_functions.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::glsl {
namespace {

/// GLSL's refract for a vector of any size; {0} is the size. GLSL declares its eta as a float.
constexpr std::string_view k_refract = R"(
dvec{0} tidemark_refract(dvec{0} i, dvec{0} n, double eta) {{
    double c = dot(n, i);
    double k = 1.0lf - eta * eta * (1.0lf - c * c);
    return k < 0.0lf ? dvec{0}(0.0lf) : eta * i - (eta * c + sqrt(k)) * n;
}}
)";

/// Returns overloads that convert any value to floats; whole numbers stay what they are.
std::string single_functions() {
    std::string text;
    for (const char* type : {"float", "vec2", "vec3", "vec4", "mat2", "mat3", "mat4"})
        for (const std::string& given : {std::string(type), double_type_of(type)})
            text += fmt::format("{0} tidemark_single({1} x) {{ return {0}(x); }}\n", type, given);
    for (const char* type : {"int", "ivec2", "ivec3", "ivec4", "uint", "uvec2", "uvec3", "uvec4", "bool"})
        text += fmt::format("{0} tidemark_single({0} x) {{ return x; }}\n", type);
    return text;
}

/// Joins, with commas, the text that `spell` returns for each parameter's type and number.
template <class Spell>
std::string listed(const BuiltinOverload& overload, Spell spell) {
    std::string list;
    for (size_t i = 0; i < overload.parameters.size(); ++i)
        list += (i > 0 ? "," : "") + spell(overload.parameters[i].type, i);
    return list;
}

/// Returns `TYPE tidemark_NAME(…) { return value; }` with promoted types.
std::string definition(std::string_view name, const BuiltinOverload& overload, std::string_view value) {
    const auto declared = [](auto type, size_t i) { return fmt::format("{} a{}", double_type_of(type), i); };
    return fmt::format("{0} tidemark_{1}({2}) {{ return {0}({3}); }}\n", double_type_of(overload.result),
                       name, listed(overload, declared), value);
}

/// Defines a function that GLSL has for floats only, by a call with floats.
std::string through_floats(std::string_view name, const BuiltinOverload& overload) {
    const auto passed = [](auto type, size_t i) {
        return is_float_type(type) ? fmt::format("{}(a{})", type, i) : fmt::format("a{}", i);
    };
    if (!name.starts_with("floatBitsTo"))
        return definition(name, overload, fmt::format("{}({})", name, listed(overload, passed)));
    // Hashes read the bits of a float. Mesa 25 replaces double(float(a)) by a, unless the float is `precise`.
    const std::string type =
        listed(overload, [](auto name_of_type, size_t) { return std::string(name_of_type); });
    std::string text = definition(name, overload, fmt::format("{}(rounded)", name));
    return text.insert(text.find('{') + 1, fmt::format(" precise {0} rounded = {0}(a0);", type));
}

std::string by_component(std::string_view name, const BuiltinOverload& overload) {
    const int size = value_type(overload.result)->rows;
    std::string parts;
    for (int i = 0; i < size; ++i) {
        const auto part = [&](auto, size_t argument) {
            return size == 1 ? fmt::format("a{}", argument) : fmt::format("a{}.{}", argument, "xyzw"[i]);
        };
        parts += fmt::format("{}tidemark_double_{}({})", i > 0 ? ", " : "", name, listed(overload, part));
    }
    return definition(name, overload, parts);
}

class Emitter {
public:
    explicit Emitter(const Signatures& own) : own_(own) {
        for (DoubleFunction& function : all_double_functions())
            functions_.push_back(std::move(function));
    }

    std::string run(const std::set<std::string_view>& used) {
        if (used.contains("single"))
            text_ += single_functions();
        for (const BuiltinFunction& function : builtin_functions())
            if (function.is(Trait::in_floats) && used.contains(function.name))
                define(function, through_floats);
        if (used.contains("refract"))
            for (int size = 2; size <= 4; ++size)
                if (!owns("refract", fmt::format("dvec{0},dvec{0},double", size)))
                    text_ += fmt::format(fmt::runtime(k_refract), size);
        for (const DoubleFunction& function : functions_)
            if (const auto* builtin = find_builtin(function.name); builtin && used.contains(function.name)) {
                require(function);
                define(*builtin, by_component);
            }
        return std::move(text_);
    }

private:
    bool owns(std::string_view name, std::string_view parameters) const {
        return own_.contains({std::string(name), std::string(parameters)});
    }

    /// Emits the overloads that the author does not define.
    template <class Define>
    void define(const BuiltinFunction& function, Define definition) {
        const auto promoted = [](auto type, size_t) { return double_type_of(type); };
        for (const BuiltinOverload& overload : overloads_of(function))
            if (!owns(function.name, listed(overload, promoted)))
                text_ += definition(function.name, overload);
    }

    /// Emits the function's text once, after the functions that it needs.
    void require(const DoubleFunction& function) {
        if (!emitted_.insert(function.name).second)
            return;
        for (const std::string_view need : function.needs)
            for (const DoubleFunction& candidate : functions_)
                if (candidate.name == need)
                    require(candidate);
        text_ += function.text.substr(1); // without the line feed that begins the literal
    }

    const Signatures& own_;
    std::vector<DoubleFunction> functions_;
    std::set<std::string_view> emitted_;
    std::string text_;
};

} // namespace

std::vector<DoubleFunction> all_double_functions() {
    std::vector<DoubleFunction> all;
    for (const auto subject :
         {double_trigonometry, double_exponentials, double_hyperbolics, double_derivatives})
        for (DoubleFunction& function : subject())
            all.push_back(std::move(function));
    return all;
}

bool is_replaced(std::string_view name) {
    static const std::set<std::string_view> k_names = [] {
        std::set<std::string_view> names{"refract"};
        for (const BuiltinFunction& function : builtin_functions())
            if (function.is(Trait::in_floats))
                names.insert(function.name);
        for (const DoubleFunction& function : all_double_functions())
            if (find_builtin(function.name))
                names.insert(function.name);
        return names;
    }();
    return k_names.contains(name);
}

std::string double_functions(const std::set<std::string_view>& used, const Signatures& own) {
    return Emitter(own).run(used);
}

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
