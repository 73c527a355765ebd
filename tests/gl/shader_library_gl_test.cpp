// shaders/lib against its twins in double.
#include "fields/lattice.hpp"
#include "fields/value_noise.hpp"
#include "gl_test.hpp"
#include "scene/load_scene.hpp"

#include <cmath>
#include <numbers>

namespace tidemark::render::shader_library_gl_test {

class ShaderLibrary : public RenderTest {
protected:
    /// A picture whose pixels hold what `body` puts into `c`, with the library's file included.
    image::Image drawn(const std::string& file, const std::string& body, Extent extent) const {
        const std::string text =
            fmt::format("#include \"{}/shaders/lib/{}\"\n"
                        "void mainImage(out vec4 c, in vec2 p) {{ c = vec4(0.0); {} }}\n",
                        TIDEMARK_SOURCE_DIR, file, body);
        auto scene = scene::load_scene(put("library.glsl", text), {.media = {}, .allow_outside = true});
        EXPECT_TRUE(scene) << to_string(scene.error());
        Renderer drawing = renderer(*scene, extent);
        return frame(drawing);
    }
    std::vector<float> library_told(const std::string& file,
                                    const std::vector<std::string>& expressions) const {
        std::string body;
        for (size_t i = 0; i < expressions.size(); ++i)
            body += fmt::format("if (int(p.x) == {}) c.r = {};\n", i, expressions[i]);
        return reds(drawn(file, body, {int(expressions.size()), 1}), expressions.size());
    }
};

constexpr Extent k_points{64, 48};

/// The same points in GLSL and here: multiples of 1/8 plus a little, exact in binary32.
constexpr const char* k_position =
    "vec3 at = vec3(p.x * 0.375 - 11.0, p.y * 0.625 - 13.0, p.x * 0.125 + p.y * 0.25 - 9.0);";

glm::dvec3 position(int x, int y) {
    const double px = x + 0.5, py = y + 0.5;
    return {px * 0.375 - 11.0, py * 0.625 - 13.0, px * 0.125 + py * 0.25 - 9.0};
}

TEST_F(ShaderLibrary, NoiseEqualsTheReference) {
    const image::Image image =
        drawn("noise.glsl",
              std::string(k_position) + "c.rgb = vec3(value_noise(at, ivec3(0)), value_noise(at.xy, "
                                        "ivec2(0)), value_noise(at, ivec3(70000, -3, 2147483647)));",
              k_points);
    const fields::IntegerLattice lattice;
    for (int y = 0; y < k_points.height; ++y)
        for (int x = 0; x < k_points.width; ++x) {
            const auto [solid, flat, far, alpha] = floats_at(image, x, y);
            const glm::dvec3 at = position(x, y);
            EXPECT_NEAR(solid, fields::value_noise(lattice, at), 3e-7);
            EXPECT_NEAR(flat, fields::value_noise(lattice, glm::dvec2(at)), 3e-7);
            EXPECT_NEAR(far, fields::value_noise(lattice, at + glm::dvec3(70000, -3, 2147483647)), 3e-7);
        }
}

TEST_F(ShaderLibrary, NoiseGradientMatchesFiniteDifferencesAndItsBound) {
    const image::Image image = drawn(
        "noise.glsl", std::string(k_position) + "c.rgb = value_noise_gradient(at, ivec3(0)).yzw;", k_points);
    const image::Image values = drawn(
        "noise.glsl",
        std::string(k_position) + "c.r = value_noise_gradient(at, ivec3(0)).x - value_noise(at, ivec3(0));",
        k_points);
    const fields::IntegerLattice lattice;
    const double e = 1e-6;
    for (int y = 0; y < k_points.height; ++y)
        for (int x = 0; x < k_points.width; ++x) {
            const auto gradient = floats_at(image, x, y);
            double square = 0;
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 step(0);
                step[axis] = e;
                const glm::dvec3 at = position(x, y);
                const double slope =
                    (fields::value_noise(lattice, at + step) - fields::value_noise(lattice, at - step)) /
                    (2 * e);
                EXPECT_NEAR(gradient[size_t(axis)], slope, 2e-6) << x << ' ' << y << ' ' << axis;
                square += slope * slope;
            }
            EXPECT_LE(std::sqrt(square), fields::k_value_noise_slope);
            EXPECT_EQ(floats_at(values, x, y)[0], 0);
        }
}

TEST_F(ShaderLibrary, NoiseAlongADirectionMatchesTheGradient) {
    const image::Image image =
        drawn("noise.glsl",
              std::string(k_position) + "vec3 along = vec3(0.6, -0.3, 1.7);\n"
                                        "vec4 noise = value_noise_gradient(at, ivec3(5, -6, 7));\n"
                                        "vec2 found = value_noise_along(at, along, ivec3(5, -6, 7));\n"
                                        "c.rgb = vec3(found.x - noise.x, found.y, dot(noise.yzw, along));",
              k_points);
    for (int y = 0; y < k_points.height; ++y)
        for (int x = 0; x < k_points.width; ++x) {
            const auto [off, found, expected, alpha] = floats_at(image, x, y);
            EXPECT_EQ(off, 0) << x << ' ' << y;
            EXPECT_NEAR(found, expected, 2e-6) << x << ' ' << y;
        }
}

/// Any noise of corners from 0 to 1 bends by no more than one of these 127 does (lib/noise.glsl).
TEST_F(ShaderLibrary, SecondDerivativeOfNoiseStaysWithinItsBound) {
    constexpr double e = 1e-4;
    constexpr int k_places = 8;
    double most = 0;
    for (unsigned corners = 1; corners < 128; ++corners) {
        const auto lattice = [&](auto x, auto y, auto z) {
            return double(corners >> (unsigned(x & 1) + 2 * unsigned(y & 1) + 4 * unsigned(z & 1)) & 1U);
        };
        for (int i = 0; i < k_places * k_places * k_places; ++i) {
            const glm::dvec3 at =
                (glm::dvec3(i % k_places, i / k_places % k_places, i / k_places / k_places) + 0.01) /
                double(k_places);
            for (int direction = 1; direction < 27; ++direction) {
                const glm::dvec3 along(direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1);
                if (along == glm::dvec3(0))
                    continue;
                const glm::dvec3 step = e * glm::normalize(along);
                const double bend =
                    (fields::value_noise(lattice, at + step) - 2 * fields::value_noise(lattice, at) +
                     fields::value_noise(lattice, at - step)) /
                    (e * e);
                most = std::max(most, std::abs(bend));
            }
        }
    }
    EXPECT_LE(most, 6.0);
    EXPECT_GT(most, 5.9);
}

TEST_F(ShaderLibrary, IntegerHashEqualsTheReferenceBitByBit) {
    const image::Image image =
        drawn("hash.glsl",
              "c.r = scatter(uvec4(lattice_point(vec3(floor(p) - 20.0, 0.0), ivec3(5, -7, 99))))"
              ".x * k_hash_unit;",
              k_points);
    const fields::IntegerLattice lattice;
    for (int y = 0; y < k_points.height; ++y)
        for (int x = 0; x < k_points.width; ++x)
            EXPECT_EQ(floats_at(image, x, y)[0], lattice(x - 15, y - 27, 99)) << x << ' ' << y;
}

TEST_F(ShaderLibrary, ProductsAreReducedAtAnySize) {
    const std::vector<std::pair<float, float>> factors = {
        {0.0F, 5.0F},      {13.0717F, 1.0F},  {0.45F, 1e6F},  {12.9246F, 1e6F},    {-3.3F, 12345.678F},
        {3.3F, -777.125F}, {1e-6F, 86400.5F}, {512.7F, 3e6F}, {0.1F, 16777216.0F}, {7.7e-5F, 1.0e7F},
    };
    const float low = 0.0212121F; // the rest of a time that is not a float
    std::vector<std::string> fractions;
    for (const auto& [a, b] : factors)
        fractions.push_back(fmt::format("fract_of_product({:.9e}, vec2({:.9e}, {:.9e}))", a, b, low));
    const std::vector<float> fraction = library_told("phase.glsl", fractions);
    for (size_t i = 0; i < factors.size(); ++i) {
        const double product = double(factors[i].first) * (double(factors[i].second) + double(low));
        const double expected = product - std::floor(product);
        const double off = std::abs(fraction[i] - expected);
        EXPECT_LT(std::min(off, 1 - off), 4e-7) << fractions[i]; // 0 and 1 are the same place
        EXPECT_GE(fraction[i], 0);
        EXPECT_LE(fraction[i], 1);
    }
}

TEST_F(ShaderLibrary, SplitProductsAddUpToTheProduct) {
    // Whole parts go through a float here, so they are kept below 2^24.
    const std::vector<std::pair<float, float>> factors = {
        {0.45F, 1e6F}, {12.9246F, 1e6F}, {-3.3F, 12345.678F}, {0.9999999F, 3.0F}, {2.0F, 3.5F}};
    std::string body = "int whole = 0; float part = 0.0;";
    for (size_t i = 0; i < factors.size(); ++i)
        body +=
            fmt::format("if (int(p.x) == {}) part = split_product({:.9e}, vec2({:.9e}, -0.03125), whole);", i,
                        factors[i].first, factors[i].second);
    const image::Image image =
        drawn("phase.glsl", body + "c.rg = vec2(float(whole), part);", {int(factors.size()), 1});
    for (size_t i = 0; i < factors.size(); ++i) {
        const auto [whole, part, b, a] = floats_at(image, int(i), 0);
        EXPECT_NEAR(double(whole) + double(part),
                    double(factors[i].first) * (double(factors[i].second) - 0.03125), 4e-7);
        EXPECT_GE(part, 0);
        EXPECT_LE(part, 1);
    }
}

TEST_F(ShaderLibrary, PhasesKeepTheirBitsForMonths) {
    const std::vector<std::pair<float, float>> factors = {{1.0F, 62.83F}, {0.15F, 1e6F},     {2.4823F, 1e6F},
                                                          {5.0F, 1e7F},   {-1.7F, 54321.0F}, {0.0F, 9.0F},
                                                          {1e-4F, 100.0F}};
    std::vector<std::string> expressions;
    for (const auto& [rate, time] : factors)
        expressions.push_back(fmt::format("phase({:.9e}, vec2({:.9e}, 0.015625))", rate, time));
    const std::vector<float> phases = library_told("phase.glsl", expressions);
    for (size_t i = 0; i < factors.size(); ++i) {
        const double angle = double(factors[i].first) * (double(factors[i].second) + 0.015625);
        EXPECT_LT(std::abs(std::remainder(phases[i] - angle, 2 * std::numbers::pi)), 1e-5) << expressions[i];
    }
}

} // namespace tidemark::render::shader_library_gl_test
