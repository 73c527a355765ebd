// The functions for doubles, run on the device at thousands of points and held against MPFR: the error stated
// beside each function is the largest that may occur.
#include "gl_test.hpp"
#include "render/gl_program.hpp"
#include "shader/builtin_functions.hpp"
#include "shader/double_functions.hpp"
#include "shader/shader_source.hpp"
#include "support/mpfr_number.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

namespace tidemark::glsl::double_functions_gl_test {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double k_smallest_normal = std::numeric_limits<double>::min();
constexpr double k_largest = std::numeric_limits<double>::max();

struct Point {
    double x = 0;
    double y = 0;
};

/// A reference, exact to 200 bits; `y` is the second argument where there is one.
using Reference = std::function<void(mpfr_ptr result, mpfr_srcptr x, mpfr_srcptr y)>;

template <class F>
Reference of_one(F function) {
    return [function](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr) { function(r, x, MPFR_RNDN); };
}

template <class F>
Reference of_two(F function) {
    return [function](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr y) { function(r, x, y, MPFR_RNDN); };
}

using Number = MpfrNumber;

/// |got - exact| in units of the last place of the double next to `exact`. A result below the normal numbers
/// may have been flushed to zero.
double error_in_ulp(double got, Number& exact) {
    const double nearest = exact.rounded();
    if (std::isnan(nearest) || std::isinf(nearest) || nearest == 0)
        return (std::isnan(nearest) && std::isnan(got)) || got == nearest ? 0 : k_infinity;
    if (std::abs(nearest) < k_smallest_normal)
        return std::abs(got) <= k_smallest_normal ? 0 : k_infinity;
    const double outwards = mpfr_cmpabs(exact.get(), Number(nearest).get()) >= 0 ? k_infinity : 0.0;
    const double unit = std::abs(std::nextafter(std::abs(nearest), outwards) - std::abs(nearest));
    Number difference;
    mpfr_sub_d(difference.get(), exact.get(), got, MPFR_RNDN);
    mpfr_div_d(difference.get(), difference.get(), unit, MPFR_RNDN);
    return std::abs(difference.rounded());
}

/// Runs `tidemark_NAME` at every point, on the device.
class Device {
public:
    Device(std::string_view name, bool binary) {
        const std::string text = fmt::format(
            "#version 450 core\n{0}layout(std430, binding = 0) readonly buffer In {{ dvec2 points[]; }};\n"
            "layout(std430, binding = 1) writeonly buffer Out {{ double results[]; }};\n"
            "layout(location = 0) out vec4 colour;\n"
            "void main() {{\n    int i = int(gl_FragCoord.x) + {1} * int(gl_FragCoord.y);\n"
            "    if (i < points.length())\n        results[i] = tidemark_{2}({3});\n    colour = "
            "vec4(0.0);\n}}\n",
            double_functions({name}, {}), k_width, name, binary ? "points[i].x, points[i].y" : "points[i].x");
        auto linked = gl::Program::link(vertex_shader(Version::core_450), text);
        EXPECT_TRUE(linked) << linked.error() << text;
        if (linked)
            program_ = *std::move(linked);
    }

    std::vector<double> run(const std::vector<Point>& points) const {
        const int rows = int((points.size() + k_width - 1) / k_width);
        GLuint buffers[2] = {}, framebuffer = 0, colours = 0, vertices = 0;
        glCreateBuffers(2, buffers);
        glNamedBufferStorage(buffers[0], GLsizeiptr(points.size() * sizeof(Point)), points.data(), 0);
        glNamedBufferStorage(buffers[1], GLsizeiptr(points.size() * sizeof(double)), nullptr, 0);
        glCreateFramebuffers(1, &framebuffer);
        glCreateRenderbuffers(1, &colours);
        glNamedRenderbufferStorage(colours, GL_RGBA8, k_width, rows);
        glNamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colours);
        glCreateVertexArrays(1, &vertices);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glViewport(0, 0, k_width, rows);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers[0]);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffers[1]);
        glUseProgram(program_.id());
        glBindVertexArray(vertices);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        std::vector<double> results(points.size());
        glGetNamedBufferSubData(buffers[1], 0, GLsizeiptr(results.size() * sizeof(double)), results.data());
        glDeleteBuffers(2, buffers);
        glDeleteFramebuffers(1, &framebuffer);
        glDeleteRenderbuffers(1, &colours);
        glDeleteVertexArrays(1, &vertices);
        return results;
    }

private:
    static constexpr int k_width = 256;
    gl::Program program_;
};

/// The values around every edge that a scheme could have: powers of two, small whole numbers, quadrants.
std::vector<double> edges() {
    std::vector<double> found;
    const auto add = [&](double x) {
        for (const double near : {x, std::nextafter(x, k_infinity), std::nextafter(x, -k_infinity)})
            found.insert(found.end(), {near, -near});
    };
    for (int power = -1021; power < 1024; power += power < -60 || power > 60 ? 37 : 1)
        add(std::ldexp(1.0, power));
    for (int whole = 1; whole < 40; ++whole)
        for (const double part : {0.25, 0.5, 1.0})
            add(whole * part);
    for (double quadrant = 1; quadrant < 6e11; quadrant = std::floor(quadrant * 1.3) + 1)
        add(quadrant * std::numbers::pi / 2);
    for (const double bound : {0.4375, 0.6875, 1.1875, 2.4375, 0.6, std::sqrt(0.5), std::sqrt(2.0),
                               709.782712893384, 710.4758600739439, -708.3964185322641, -745.13321910194122})
        add(bound);
    return found;
}

struct Domain {
    double low = -k_infinity;
    double high = k_infinity;
    double typical = 10; ///< half of the random points lie within
    bool contains(double x) const { return x >= low && x <= high; }
};

std::vector<double> points_in(const Domain& domain) {
    std::mt19937_64 random(20261121);
    std::uniform_real_distribution<double> uniform(-domain.typical, domain.typical);
    std::uniform_real_distribution<double> exponent(-1020, 1024);
    std::vector<double> points;
    for (const double x : edges())
        if (domain.contains(x))
            points.push_back(x);
    while (points.size() < 20'000) {
        const double near = uniform(random);
        const double sign = random() % 2 == 0 ? 1.0 : -1.0;
        const double wide = sign * std::exp2(exponent(random));
        const double middle = sign * std::exp2(exponent(random) / 26);
        for (const double x : {near, near, wide, middle})
            if (domain.contains(x))
                points.push_back(x);
    }
    return points;
}

struct Subject {
    std::string_view name;
    Domain domain;
    Reference reference;
};

const std::vector<Subject>& subjects() {
    static const std::vector<Subject> k_subjects = {
        {"sin", {-1e12, 1e12}, of_one(mpfr_sin)},
        {"cos", {-1e12, 1e12}, of_one(mpfr_cos)},
        {"tan", {-1e12, 1e12}, of_one(mpfr_tan)},
        {"asin", {-1, 1, 1}, of_one(mpfr_asin)},
        {"acos", {-1, 1, 1}, of_one(mpfr_acos)},
        {"atan", {}, of_one(mpfr_atan)},
        {"exp", {-800, 800, 700}, of_one(mpfr_exp)},
        {"exp2", {-1200, 1200, 1000}, of_one(mpfr_exp2)},
        {"log", {0, k_largest}, of_one(mpfr_log)},
        {"log2", {0, k_largest}, of_one(mpfr_log2)},
        {"sinh", {-720, 720}, of_one(mpfr_sinh)},
        {"cosh", {-720, 720}, of_one(mpfr_cosh)},
        {"tanh", {}, of_one(mpfr_tanh)},
        {"asinh", {}, of_one(mpfr_asinh)},
        {"acosh", {1, k_largest}, of_one(mpfr_acosh)},
        {"atanh", {-1, 1, 1}, of_one(mpfr_atanh)},
        {"radians",
         {-1e300, 1e300},
         [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr) {
             mpfr_const_pi(r, MPFR_RNDN);
             mpfr_mul(r, r, x, MPFR_RNDN);
             mpfr_div_ui(r, r, 180, MPFR_RNDN);
         }},
        {"degrees",
         {-1e300, 1e300},
         [](mpfr_ptr r, mpfr_srcptr x, mpfr_srcptr) {
             Number pi;
             mpfr_const_pi(pi.get(), MPFR_RNDN);
             mpfr_mul_ui(r, x, 180, MPFR_RNDN);
             mpfr_div(r, r, pi.get(), MPFR_RNDN);
         }},
    };
    return k_subjects;
}

double stated_bound(std::string_view name) {
    for (const DoubleFunction& function : all_double_functions())
        if (function.name == name)
            return function.ulp;
    return 0;
}

void expect_within_bound(std::string_view name, const std::vector<Point>& points,
                         const std::vector<double>& results, const Reference& reference) {
    double worst = 0, sum = 0;
    Point where;
    double there = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        Number x(points[i].x), y(points[i].y), exact;
        reference(exact.get(), x.get(), y.get());
        const double error = error_in_ulp(results[i], exact);
        sum += error;
        if (!(error <= worst)) {
            worst = error;
            where = points[i];
            there = results[i];
        }
    }
    std::printf("%-8.*s %.3f ulp at most, %.3f on average\n", int(name.size()), name.data(), worst,
                sum / double(points.size()));
    EXPECT_LE(worst, stated_bound(name))
        << fmt::format("{}({:a}, {:a}) gave {:a} = {}", name, where.x, where.y, there, there);
}

TEST(DoubleFunctions, every_stated_bound_has_a_reference) {
    for (const DoubleFunction& function : all_double_functions()) {
        if (function.ulp == 0)
            continue;
        const auto tested = [&](const Subject& subject) { return subject.name == function.name; };
        EXPECT_TRUE(overloads_of(*find_builtin(function.name)).front().parameters.size() == 2 ||
                    std::any_of(subjects().begin(), subjects().end(), tested))
            << function.name;
    }
}

TEST(DoubleFunctions, functions_of_one_argument_keep_their_bounds) {
    for (const Subject& subject : subjects()) {
        std::vector<Point> points;
        for (const double x : points_in(subject.domain))
            points.push_back({x, 0});
        expect_within_bound(subject.name, points, Device(subject.name, false).run(points), subject.reference);
    }
}

TEST(DoubleFunctions, pow_keeps_its_bound_up_to_overflow) {
    std::vector<Point> points;
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> exponent(-1074, 1080);
    for (const double x : points_in({1e-300, 1e300, 10})) {
        const double target = exponent(random); // x^y = 2^target
        const double natural = std::log2(x) == 0 ? target : target / std::log2(x);
        points.push_back({x, natural});
        points.push_back({x, std::nearbyint(std::fmod(natural, 20.0) * 2) / 2});
    }
    expect_within_bound("pow", points, Device("pow", true).run(points), of_two(mpfr_pow));
}

TEST(DoubleFunctions, atan_of_two_keeps_its_bound_in_every_quadrant) {
    std::vector<Point> points;
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> ratio(-40, 40);
    for (const double x : points_in({-1e200, 1e200, 10})) {
        const double y = x * std::exp2(ratio(random)) * (random() % 2 ? 1 : -1);
        if (std::abs(y) >= k_smallest_normal) // smaller ones may be flushed
            points.push_back({y, x});
        points.push_back({x, 3.0});
    }
    expect_within_bound("atan", points, Device("atan", true).run(points), of_two(mpfr_atan2));
}

struct Special {
    std::string_view name;
    std::vector<std::pair<double, double>> values; ///< argument and result
};

TEST(DoubleFunctions, special_values_are_mathematically_correct) {
    const Special specials[] = {
        {"sin", {{0, 0}, {-0.0, 0}, {k_infinity, k_nan}, {-k_infinity, k_nan}, {k_nan, k_nan}}},
        {"cos", {{0, 1}, {-0.0, 1}, {k_infinity, k_nan}, {k_nan, k_nan}}},
        {"tan", {{0, 0}, {k_infinity, k_nan}, {k_nan, k_nan}}},
        {"asin", {{0, 0}, {1.0000001, k_nan}, {-2, k_nan}, {k_infinity, k_nan}, {k_nan, k_nan}}},
        {"acos", {{1, 0}, {1.0000001, k_nan}, {-2, k_nan}, {k_infinity, k_nan}, {k_nan, k_nan}}},
        {"atan",
         {{0, 0}, {k_infinity, std::numbers::pi / 2}, {-k_infinity, -std::numbers::pi / 2}, {k_nan, k_nan}}},
        {"exp",
         {{0, 1},
          {-0.0, 1},
          {k_infinity, k_infinity},
          {-k_infinity, 0},
          {k_nan, k_nan},
          {1e300, k_infinity},
          {-1e300, 0}}},
        {"exp2", {{0, 1}, {k_infinity, k_infinity}, {-k_infinity, 0}, {k_nan, k_nan}, {10, 1024}, {-1, 0.5}}},
        {"log",
         {{1, 0},
          {0, -k_infinity},
          {-0.0, -k_infinity},
          {-1, k_nan},
          {k_infinity, k_infinity},
          {-k_infinity, k_nan},
          {k_nan, k_nan}}},
        {"log2", {{1, 0}, {0, -k_infinity}, {-1, k_nan}, {k_infinity, k_infinity}, {k_nan, k_nan}, {8, 3}}},
        {"sinh", {{0, 0}, {k_infinity, k_infinity}, {-k_infinity, -k_infinity}, {k_nan, k_nan}}},
        {"cosh", {{0, 1}, {k_infinity, k_infinity}, {-k_infinity, k_infinity}, {k_nan, k_nan}}},
        {"tanh", {{0, 0}, {k_infinity, 1}, {-k_infinity, -1}, {k_nan, k_nan}}},
        {"asinh", {{0, 0}, {k_infinity, k_infinity}, {-k_infinity, -k_infinity}, {k_nan, k_nan}}},
        {"acosh", {{1, 0}, {0.5, k_nan}, {k_infinity, k_infinity}, {k_nan, k_nan}}},
        {"atanh", {{0, 0}, {1, k_infinity}, {-1, -k_infinity}, {2, k_nan}, {k_nan, k_nan}}},
    };
    for (const auto& [name, values] : specials) {
        std::vector<Point> points;
        for (const auto& [argument, result] : values)
            points.push_back({argument, 0});
        const std::vector<double> got = Device(name, false).run(points);
        for (size_t i = 0; i < values.size(); ++i) {
            const double wanted = values[i].second;
            EXPECT_TRUE(std::isnan(wanted) ? std::isnan(got[i]) : got[i] == wanted)
                << name << '(' << values[i].first << ") gave " << got[i] << ", not " << wanted;
        }
    }
}

TEST(DoubleFunctions, special_values_of_two_arguments) {
    const auto check = [](std::string_view name, const std::vector<std::array<double, 3>>& rows) {
        std::vector<Point> points;
        for (const auto& [x, y, result] : rows)
            points.push_back({x, y});
        const std::vector<double> got = Device(name, true).run(points);
        for (size_t i = 0; i < rows.size(); ++i)
            EXPECT_TRUE(std::isnan(rows[i][2]) ? std::isnan(got[i]) : got[i] == rows[i][2])
                << name << '(' << rows[i][0] << ", " << rows[i][1] << ") gave " << got[i];
    };
    check("pow", {{-3, 2, 9},
                  {-3, 1, -3},
                  {-3, 4, 81},
                  {-3, 3, k_nan},
                  {-3, 0.5, k_nan},
                  {-3, 0, 1},
                  {0, 0, 1},
                  {0, 2.5, 0},
                  {0, -1, k_infinity},
                  {1, k_infinity, 1},
                  {2, k_infinity, k_infinity},
                  {2, -k_infinity, 0},
                  {0.5, k_infinity, 0},
                  {k_infinity, 0.5, k_infinity},
                  {k_infinity, -0.5, 0},
                  {k_nan, 1.5, k_nan},
                  {2, k_nan, k_nan},
                  {2, 1e308, k_infinity},
                  {1, 1e308, 1}});
    constexpr double pi = std::numbers::pi;
    check("atan", {{0, 1, 0},
                   {0, -1, pi},
                   {-0.0, -1, -pi},
                   {0, 0, 0},
                   {1, 0, pi / 2},
                   {-1, 0, -pi / 2},
                   {k_infinity, k_infinity, pi / 4},
                   {k_infinity, -k_infinity, 3 * pi / 4},
                   {1, k_infinity, 0},
                   {k_infinity, 1, pi / 2},
                   {k_nan, 1, k_nan},
                   {1, k_nan, k_nan}});
}

/// Beyond 1e12 nothing is promised but that nothing blows up.
TEST(DoubleFunctions, angles_beyond_the_reduction_stay_bounded) {
    std::vector<Point> points;
    for (double x = 1e12; x < 1e308; x *= 1.7)
        points.insert(points.end(), {{x, 0}, {-x, 0}});
    points.push_back({k_largest, 0});
    for (const char* name : {"sin", "cos"}) {
        const std::vector<double> got = Device(name, false).run(points);
        for (size_t i = 0; i < points.size(); ++i)
            EXPECT_LE(std::abs(got[i]), 1.0000001) << name << '(' << points[i].x << ')';
    }
}

TEST(DoubleFunctions, subnormal_arguments_give_small_results_or_zero) {
    std::vector<Point> points;
    for (int power = -1074; power < -1021; ++power)
        points.insert(points.end(), {{std::ldexp(1.0, power), 0}, {-std::ldexp(1.0, power), 0}});
    for (const char* name : {"sin", "tan", "asin", "atan", "sinh", "tanh", "asinh", "atanh"}) {
        const std::vector<double> got = Device(name, false).run(points);
        for (size_t i = 0; i < points.size(); ++i)
            EXPECT_TRUE(got[i] == 0 || got[i] == points[i].x) << name << '(' << points[i].x << ") " << got[i];
    }
}

} // namespace tidemark::glsl::double_functions_gl_test
