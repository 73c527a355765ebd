// Frames that are the mean of several samples.
#include "gl_test.hpp"
#include "media/image.hpp"
#include "render/exposure.hpp"

#include <gmock/gmock.h>

namespace tidemark::render::exposure_gl_test {

using image::Image;

class ExposureTest : public RenderTest {
protected:
    Image exposed(const std::string& text, const Exposure& exposure, Extent tile, int frame = 0) const {
        auto renderer = Renderer::create(
            scene_of(text), {.extent = k_extent, .samples = image::SampleType::f32, .tile = tile});
        EXPECT_TRUE(renderer) << to_string(renderer.error());
        const FrameState state{.frame = frame, .extent = k_extent, .fps = 10};
        renderer->draw(inputs_of(state));
        return *draw_in_tiles(*renderer, expose(exposure, state), [] { return true; });
    }
    static constexpr Extent k_extent{16, 8};
};

TEST_F(ExposureTest, an_edge_within_a_pixel_covers_its_part_of_the_light) {
    const Image image = exposed("void mainImage(out vec4 c, in vec2 p) { c = vec4(step(5.25, p.x)); }",
                                {.samples = 256, .clamped = true}, k_extent);
    EXPECT_EQ(floats_at(image, 4, 3)[0], 0);
    EXPECT_NEAR(image::light_of_srgb(double(floats_at(image, 5, 3)[0])), 0.75, 0.01);
    EXPECT_EQ(floats_at(image, 6, 3)[0], 1);
}

TEST_F(ExposureTest, motion_is_blurred_over_the_shutter_time) {
    const std::string lit = "void mainImage(out vec4 c, in vec2 p) { c = vec4(step(3.02, iTime)); }";
    const auto light = [&](double shutter) {
        const Exposure exposure{.samples = 200, .shutter = shutter, .clamped = true};
        return image::light_of_srgb(double(floats_at(exposed(lit, exposure, k_extent, 30), 0, 0)[0]));
    };
    EXPECT_NEAR(light(0.5), 0.6, 0.01); // 0.02 of 0.05 s are dark
    EXPECT_NEAR(light(0.25), 0.2, 0.01);
}

TEST_F(ExposureTest, read_passes_move_with_the_samples) {
    put("buffer.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(step(3.02, iTime)); }");
    const Image image =
        exposed("#iChannel0 \"buffer.glsl\"\n"
                "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }",
                {.samples = 100, .shutter = 0.5, .clamped = true}, k_extent, 30);
    EXPECT_NEAR(image::light_of_srgb(double(floats_at(image, 0, 0)[0])), 0.6, 0.02);
}

TEST_F(ExposureTest, tiles_leave_no_seams) {
    const std::string text =
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(p / 3.0), fract(iTime), 1); }";
    const Exposure exposure{.samples = 7, .shutter = 1};
    EXPECT_EQ(exposed(text, exposure, k_extent), exposed(text, exposure, {4, 2}));
}

} // namespace tidemark::render::exposure_gl_test
