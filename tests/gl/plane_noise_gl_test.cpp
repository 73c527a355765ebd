// Functions of shaders/lib for the plane: the noise's gradient, and cells.
#include "fields/lattice.hpp"
#include "fields/value_noise.hpp"
#include "gl_test.hpp"
#include "scene/load_scene.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::render::plane_noise_gl_test {

class PlaneNoise : public RenderTest {
protected:
    image::Image drawn(const std::string& file, const std::string& body, Extent extent) const {
        const std::string text = fmt::format("#include \"{}/shaders/lib/{}\"\n"
                                             "void mainImage(out vec4 c, in vec2 p) {{ {} }}\n",
                                             TIDEMARK_SOURCE_DIR, file, body);
        auto scene = scene::load_scene(put("library.glsl", text), {.media = {}, .allow_outside = true});
        EXPECT_TRUE(scene) << to_string(scene.error());
        Renderer drawing = renderer(*scene, extent);
        return frame(drawing);
    }
};

TEST_F(PlaneNoise, gradient_matches_finite_differences) {
    // Places are multiples of 1/16, exact in binary32.
    const image::Image image = drawn("noise.glsl",
                                     R"(vec2 at = p * vec2(0.375, 0.625) - vec2(11.0, 13.0);
        vec3 noise = value_noise_gradient(at, ivec2(70000, -3));
        c = vec4(noise.x - value_noise(at, ivec2(70000, -3)), noise.yz, 1.0);)",
                                     {64, 48});
    const fields::IntegerLattice lattice;
    const double e = 1e-5;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            const auto [off, along_x, along_y, alpha] = floats_at(image, x, y);
            const glm::dvec2 at((x + 0.5) * 0.375 - 11.0 + 70000.0, (y + 0.5) * 0.625 - 13.0 - 3.0);
            const auto slope = [&](glm::dvec2 step) {
                return (fields::value_noise(lattice, at + step) - fields::value_noise(lattice, at - step)) /
                       (2.0 * e);
            };
            EXPECT_NEAR(off, 0.0, 1e-7) << x << ' ' << y;
            EXPECT_NEAR(along_x, slope({e, 0.0}), 3e-5) << x << ' ' << y;
            EXPECT_NEAR(along_y, slope({0.0, e}), 3e-5) << x << ' ' << y;
        }
}

TEST_F(PlaneNoise, nearest_cell_is_the_nearest_of_all) {
    // From the library's own hash, the points of 25 cells.
    const image::Image image = drawn("cells.glsl",
                                     R"(vec2 at = p * vec2(0.173, 0.211) - 5.0;
        vec3 found = nearest_cell(at, 0.3);
        float least = 9.0;
        for (int i = 0; i < 25; ++i) {
            vec2 cell = floor(at) + vec2(i % 5 - 2, i / 5 - 2);
            vec2 angle = 6.283185307 * (cell_hash(cell) + vec2(0.3, -0.3));
            least = min(least, distance(cell + 0.5 + 0.32 * sin(angle), at));
        }
        c = vec4(found.z, least, length(found.xy), 1.0);)",
                                     {256, 192});
    float farthest = 0.0F;
    for (int y = 0; y < 192; ++y)
        for (int x = 0; x < 256; ++x) {
            const auto [found, least, length, alpha] = floats_at(image, x, y);
            EXPECT_NEAR(found, least, 1e-6) << x << ' ' << y;
            EXPECT_NEAR(found, length, 1e-6) << x << ' ' << y;
            if (x > 0) {
                EXPECT_LE(std::abs(found - floats_at(image, x - 1, y)[0]), 0.173F + 1e-5F) << x << ' ' << y;
            }
            farthest = std::max(farthest, found);
        }
    EXPECT_LT(farthest, 1.16F);
    EXPECT_GT(farthest, 0.6F);
}

} // namespace tidemark::render::plane_noise_gl_test
