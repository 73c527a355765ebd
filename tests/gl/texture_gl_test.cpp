#include "gl_test.hpp"
#include "media/generated_textures.hpp"
#include "media/picture_file.hpp"
#include "scene/scene.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace tidemark::render::texture_gl_test {

using image::Image;
using image::SampleType;
using testing::ElementsAre;
using testing::FloatEq;
using Values = std::vector<float>;

class TextureTest : public RenderTest {
protected:
    /// Writes a picture file; `samples` are from the top row down.
    void put_picture(const std::string& name, Extent extent, int channels,
                     const std::vector<int>& samples) const {
        Image upright(extent, channels, SampleType::u8);
        for (size_t i = 0; i < samples.size(); ++i)
            upright.u8()[i] = uint8_t(samples[i]);
        const auto written = image::write_picture(path_of(name), image::flipped(upright));
        ASSERT_TRUE(written) << to_string(written.error());
    }
    void put_floats(const std::string& name, Extent extent, const std::vector<float>& samples) const {
        Image picture(extent, 3, SampleType::f32);
        std::copy(samples.begin(), samples.end(), picture.f32().begin());
        const auto written = image::write_picture(path_of(name), picture, {image::SampleDepth::f32});
        ASSERT_TRUE(written) << to_string(written.error());
    }
    /// Returns the values of the expressions with that sampling of iChannel0.
    Values sampled(const std::string& picture, const std::vector<std::string>& expressions,
                   const scene::Sampling& sampling = {}) const {
        scene::Scene scene = scene_of(telling(expressions, fmt::format("#iChannel0 \"{}\"", picture)));
        scene.passes[0].channels[0].sampling = sampling;
        Renderer drawing = renderer(std::move(scene), {64, 1});
        Values values = reds(frame(drawing), expressions.size());
        for (float& value : values)
            value = in_bytes(value);
        return values;
    }
    /// 0..255; in eighths, because v / 255 * 255 is not always v.
    static float in_bytes(float value) { return std::round(value * 255 * 8) / 8; }
    static std::string at(float u, float v = 0.5f, const char* component = "r") {
        return fmt::format("texture(iChannel0, vec2({:f}, {:f})).{}", u, v, component);
    }
    static constexpr scene::Sampling k_nearest{scene::Filter::nearest, scene::Filter::nearest,
                                               scene::Mipmaps::none, scene::Wrap::repeat, true};
};

TEST_F(TextureTest, vflip_puts_the_bottom_row_at_0) {
    put_picture("rows.png", {2, 3}, 3, {10, 0, 0, 11, 0, 0, 20, 0, 0, 21, 0, 0, 30, 0, 0, 31, 0, 0});
    const std::vector<std::string> places = {
        "texelFetch(iChannel0, ivec2(0, 0), 0).r", "texelFetch(iChannel0, ivec2(1, 0), 0).r",
        "texelFetch(iChannel0, ivec2(0, 2), 0).r", at(0.25f, 0.9f), at(0.75f, 0.1f)};
    scene::Sampling sampling = k_nearest;
    EXPECT_THAT(sampled("rows.png", places, sampling), ElementsAre(30, 31, 10, 10, 31));
    sampling.vflip = false;
    EXPECT_THAT(sampled("rows.png", places, sampling), ElementsAre(10, 11, 30, 30, 11));
}

TEST_F(TextureTest, one_picture_may_be_read_with_and_without_vflip) {
    put_picture("rows.png", {1, 2}, 1, {100, 200});
    scene::Scene scene =
        scene_of(telling({"texelFetch(iChannel0, ivec2(0), 0).r", "texelFetch(iChannel1, ivec2(0), 0).r"},
                         "#iChannel0 \"rows.png\"\n#iChannel1 \"rows.png\""));
    scene.passes[0].channels[1].sampling.vflip = false;
    Renderer drawing = renderer(std::move(scene), {2, 1});
    const Image image = frame(drawing);
    EXPECT_EQ(in_bytes(floats_at(image, 0, 0)[0]), 200);
    EXPECT_EQ(in_bytes(floats_at(image, 1, 0)[0]), 100);
}

TEST_F(TextureTest, filters) {
    put_picture("step.png", {2, 1}, 1, {0, 200});
    scene::Sampling sampling = k_nearest;
    EXPECT_THAT(sampled("step.png", {at(0.25f), at(0.49f), at(0.51f), at(0.75f)}, sampling),
                ElementsAre(0, 0, 200, 200));
    sampling.magnify = sampling.minify = scene::Filter::linear;
    const Values linear = sampled("step.png", {at(0.25f), at(0.5f), at(0.75f)}, sampling);
    EXPECT_NEAR(linear[0], 0, 1);
    EXPECT_NEAR(linear[1], 100, 1);
    EXPECT_NEAR(linear[2], 200, 1);
}

TEST_F(TextureTest, magnification_and_minification_have_separate_filters) {
    put_picture("step.png", {2, 1}, 1, {0, 200});
    scene::Sampling sampling = k_nearest;
    sampling.magnify =
        scene::Filter::linear; // constant coordinates have no derivative: that is magnification
    EXPECT_NEAR(sampled("step.png", {at(0.5f)}, sampling)[0], 100, 1);
    EXPECT_THAT(
        sampled("step.png", {"textureGrad(iChannel0, vec2(0.49, 0.5), vec2(4.0), vec2(4.0)).r"}, sampling),
        ElementsAre(0));
}

TEST_F(TextureTest, wraps) {
    put_picture("three.png", {3, 3}, 1, {10, 20, 30, 40, 50, 60, 70, 80, 90});
    const std::vector<std::string> beyond = {at(-0.16f), at(1.16f), at(1.5f), at(0.5f, -0.16f),
                                             at(0.5f, 1.16f)};
    scene::Sampling sampling = k_nearest;
    EXPECT_THAT(sampled("three.png", beyond, sampling), ElementsAre(60, 40, 50, 20, 80));
    sampling.wrap = scene::Wrap::clamp;
    EXPECT_THAT(sampled("three.png", beyond, sampling), ElementsAre(40, 60, 60, 80, 20));
    sampling.wrap = scene::Wrap::mirror;
    EXPECT_THAT(sampled("three.png", beyond, sampling), ElementsAre(40, 60, 50, 80, 20));
}

TEST_F(TextureTest, picture_of_one_channel_is_red_alone) {
    put_picture("grey.png", {1, 1}, 1, {200});
    put_picture("rgb.png", {1, 1}, 3, {200, 100, 50});
    for (const char* name : {"grey.png", "rgb.png"}) {
        scene::Scene scene = scene_of(
            telling({at(0.5f, 0.5f, "r"), at(0.5f, 0.5f, "g"), at(0.5f, 0.5f, "b"), at(0.5f, 0.5f, "a")},
                    fmt::format("#iChannel0 \"{}\"", name)));
        std::get<scene::Picture>(scene.passes[0].channels[0].input).one_channel = true;
        Renderer drawing = renderer(scene, {4, 1});
        EXPECT_THAT(reds(frame(drawing), 4), ElementsAre(FloatEq(200 / 255.0F), 0, 0, 1)) << name;
    }
}

TEST_F(TextureTest, mipmaps) {
    std::vector<int> squares;
    for (int i = 0; i < 64; ++i)
        squares.push_back((i / 8 + i) % 2 == 0 ? 0 : 200);
    put_picture("squares.png", {8, 8}, 1, squares);
    const std::vector<std::string> looks = {
        "textureLod(iChannel0, vec2(0.0625), 3.0).r",
        "textureGrad(iChannel0, vec2(0.0625), vec2(1.0, 0.0), vec2(0.0, 1.0)).r",
        "float(textureSize(iChannel0, 2).x) / 255.0"};
    scene::Sampling sampling = k_nearest;
    const float corner = sampled("squares.png", looks, sampling)[0];
    EXPECT_EQ(corner, 200); // the bottom row's first: (7 + 0) is odd
    for (const scene::Mipmaps mipmaps : {scene::Mipmaps::nearest, scene::Mipmaps::linear}) {
        sampling.mipmaps = mipmaps;
        const Values values = sampled("squares.png", looks, sampling);
        EXPECT_NEAR(values[0], 100, 1);
        EXPECT_NEAR(values[1], 100, 1);
        EXPECT_NEAR(values[2], 2, 1e-4);
    }
}

TEST_F(TextureTest, grey_is_spread_over_red_green_and_blue) {
    put_picture("grey.png", {1, 1}, 1, {77});
    EXPECT_THAT(sampled("grey.png",
                        {at(0.5f, 0.5f, "r"), at(0.5f, 0.5f, "g"), at(0.5f, 0.5f, "b"), at(0.5f, 0.5f, "a")}),
                ElementsAre(77, 77, 77, 255));
    put_picture("veil.png", {1, 1}, 2, {77, 33});
    EXPECT_THAT(sampled("veil.png",
                        {at(0.5f, 0.5f, "r"), at(0.5f, 0.5f, "g"), at(0.5f, 0.5f, "b"), at(0.5f, 0.5f, "a")}),
                ElementsAre(77, 77, 77, 33));
}

TEST_F(TextureTest, colours_are_neither_decoded_nor_multiplied_by_alpha) {
    put_picture("glass.png", {1, 1}, 4, {200, 100, 50, 25});
    EXPECT_THAT(sampled("glass.png",
                        {at(0.5f, 0.5f, "r"), at(0.5f, 0.5f, "g"), at(0.5f, 0.5f, "b"), at(0.5f, 0.5f, "a")}),
                ElementsAre(200, 100, 50, 25));
}

TEST_F(TextureTest, picture_without_alpha_has_alpha_1) {
    put_picture("rgb.png", {1, 1}, 3, {200, 100, 50});
    EXPECT_THAT(sampled("rgb.png", {at(0.5f, 0.5f, "b"), at(0.5f, 0.5f, "a")}), ElementsAre(50, 255));
}

TEST_F(TextureTest, float_picture_keeps_its_values) {
    put_floats("bright.exr", {1, 1}, {1000.25f, -2.5f, 1e-3f});
    Renderer drawing =
        renderer(telling({at(0.5f, 0.5f, "r"), at(0.5f, 0.5f, "g"), at(0.5f, 0.5f, "b"), at(0.5f, 0.5f, "a")},
                         "#iChannel0 \"bright.exr\""),
                 {4, 1});
    EXPECT_THAT(reds(frame(drawing), 4), ElementsAre(1000.25f, -2.5f, 1e-3f, 1.0f));
}

TEST_F(TextureTest, sizes_reach_iChannelResolution) {
    put_picture("five.png", {5, 7}, 3, std::vector<int>(105));
    // 1 and 3 are read; of the others 0 has a picture of its own, and 2 would read noise.
    const std::string reads =
        "(texelFetch(iChannel1, ivec2(0), 0).r + texelFetch(iChannel3, ivec2(0), 0).r > 9.0 ? 1.0 : 0.0)";
    EXPECT_THAT(
        told({"iChannelResolution[1].x + " + reads, "iChannelResolution[1].y", "iChannelResolution[1].z",
              "iChannelResolution[3].x", "iChannelResolution[3].z", "iChannelResolution[0].x",
              "iChannelResolution[0].z", "iChannelResolution[2].x", "iChannelResolution[2].z"},
             {}, "#iChannel0 \"five.png\"\n#iChannel1 \"five.png\""),
        ElementsAre(5, 7, 1, 256, 1, 5, 1, 256, 1));
}

TEST_F(TextureTest, directives_choose_the_sampling) {
    put_picture("step.png", {2, 1}, 1, {0, 200});
    const auto look = [&](const std::string& directives, const std::string& expression) {
        return in_bytes(told({expression}, {}, "#iChannel0 \"step.png\"\n" + directives)[0]);
    };
    EXPECT_NEAR(look("", at(0.5f)), 100, 1); // the extension's defaults: linear, repeat
    EXPECT_NEAR(look("", at(1.25f)), 0, 1);
    EXPECT_EQ(look("#iChannel0::MagFilter \"Nearest\"", at(0.51f)), 200);
    EXPECT_NEAR(look("#iChannel0::WrapMode \"Clamp\"", at(1.25f)), 200, 1);
    EXPECT_NEAR(look("#iChannel0::WrapMode \"Mirror\"", at(1.75f)), 0, 1);
    EXPECT_NEAR(look("", "textureLod(iChannel0, vec2(0.75, 0.5), 1.0).r"), 200, 1);
    EXPECT_NEAR(
        look("#iChannel0::MinFilter \"LinearMipMapLinear\"", "textureLod(iChannel0, vec2(0.75, 0.5), 1.0).r"),
        100, 1);
}

TEST_F(TextureTest, channel_of_none_is_opaque_black) {
    scene::Scene scene = scene_of(telling(
        {"texture(iChannel0, vec2(0.5)).r", "texture(iChannel0, vec2(0.5)).a", "iChannelResolution[0].x"}));
    ASSERT_TRUE(scene::override_channel(scene, "0=none"));
    Renderer drawing = renderer(std::move(scene), {3, 1});
    EXPECT_THAT(reds(frame(drawing), 3), ElementsAre(0, 1, 0));
}

class NoiseTest : public TextureTest {
protected:
    /// Whether the expression holds in every texel of the noise on iChannel0.
    void expect_everywhere(const std::string& condition, bool vflip) const {
        scene::Scene scene = scene_of(fmt::format(R"(
            vec4 n(ivec2 t) {{ return texelFetch(iChannel0, t & 255, 0); }}
            void mainImage(out vec4 c, in vec2 p) {{ ivec2 t = ivec2(p); c = vec4({} ? 1.0 : 0.0); }})",
                                                  condition));
        scene.passes[0].channels[0].sampling.vflip = vflip;
        Renderer drawing = renderer(std::move(scene), {256, 256}, SampleType::u8);
        EXPECT_TRUE(std::ranges::all_of(frame(drawing).u8(), [](uint8_t sample) { return sample == 255; }))
            << condition;
    }
};

TEST_F(NoiseTest, pairs_of_channels_are_shifted_copies) {
    expect_everywhere("n(t).r == n(t + ivec2(37, -17)).g", true);
    expect_everywhere("n(t).b == n(t + ivec2(37, -17)).a", true);
    expect_everywhere("n(t).r == n(t + ivec2(37, 17)).g", false);
    expect_everywhere("n(t).b == n(t + ivec2(37, 17)).a", false);
}

TEST_F(NoiseTest, texel_centres_return_their_texel_and_repeat) {
    expect_everywhere("abs(textureLod(iChannel0, p / 256.0, 0.0).g - n(t).g) < 0.002", true);
    expect_everywhere("abs(textureLod(iChannel0, p / 256.0 + vec2(3.0, -2.0), 0.0).g - n(t).g) < 0.002",
                      true);
}

TEST_F(NoiseTest, equals_the_picture_of_bake) {
    Renderer drawing =
        renderer("void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0); }",
                 {256, 256}, SampleType::u8);
    EXPECT_EQ(image::without_alpha(frame(drawing)), image::without_alpha(image::make_noise()));
}

TEST_F(NoiseTest, the_last_mipmap_is_the_mean) {
    const Values last =
        told({"textureLod(iChannel0, vec2(0.5), 8.0).r", "textureLod(iChannel0, vec2(0.5), 8.0).a"});
    EXPECT_NEAR(last[0], 0.5, 0.02);
    EXPECT_NEAR(last[1], 0.5, 0.02);
}

/// 128 GiB: more than llvmpipe takes for a texture, and than other drivers have.
TEST_F(TextureTest, failed_allocation_of_storage_is_detected) {
    EXPECT_TRUE(gl::has_storage(gl::make_volume_texture({4, 4}, 4, GL_RGBA32F, 1)));
    EXPECT_FALSE(gl::has_storage(gl::make_volume_texture({2048, 2048}, 2048, GL_RGBA32F, 1)));
    EXPECT_EQ(glGetError(), GLenum(GL_OUT_OF_MEMORY));
}

} // namespace tidemark::render::texture_gl_test
