// Helpers of the renderer's tests: one headless context for the executable, a folder for the scenes of a
// test, and functions that evaluate expressions in a shader.
#pragma once

#include "host/gl_context.hpp"
#include "media/image.hpp"
#include "render/renderer.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"
#include "support/temporary_folder.hpp"

#include <GL/glcorearb.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::render {

namespace fs = std::filesystem;

/// The context of the executable; ends it with "skipped" where there is none to be had.
class ContextEnvironment : public testing::Environment {
public:
    void SetUp() override {
        auto made = host::HeadlessContext::create();
        if (!made) {
            std::fprintf(stderr, "skipped: %s\n", made.error().message.c_str());
            std::exit(77);
        }
        context_ = *std::move(made);
    }
    void TearDown() override { context_.reset(); }

private:
    std::optional<host::HeadlessContext> context_;
};

inline testing::Environment* const k_context = testing::AddGlobalTestEnvironment(new ContextEnvironment);

using Bytes4 = std::array<int, 4>;
using Floats4 = std::array<float, 4>;

inline Bytes4 bytes_at(const image::Image& image, int x, int y) {
    const uint8_t* pixel = &image.u8()[4 * (size_t(y) * size_t(image.extent.width) + size_t(x))];
    return {pixel[0], pixel[1], pixel[2], pixel[3]};
}

inline Floats4 floats_at(const image::Image& image, int x, int y) {
    const float* pixel = &image.f32()[4 * (size_t(y) * size_t(image.extent.width) + size_t(x))];
    return {pixel[0], pixel[1], pixel[2], pixel[3]};
}

/// A test with a folder of its own, which fails if it leaves a GL error.
class RenderTest : public testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR)); }

    fs::path put(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    std::string path_of(const std::string& name) const { return (folder_ / name).string(); }

    scene::Scene scene_of(const std::string& text) const {
        auto scene = scene::load_scene(put("scene.glsl", text));
        EXPECT_TRUE(scene) << to_string(scene.error());
        return scene ? *scene : scene::Scene{};
    }
    Result<Renderer> create(const std::string& text, Extent extent,
                            image::SampleType samples = image::SampleType::u8) const {
        return Renderer::create(scene_of(text), {extent, samples});
    }
    /// For scenes that are known to be good.
    Renderer renderer(scene::Scene scene, Extent extent,
                      image::SampleType samples = image::SampleType::f32) const {
        auto made = Renderer::create(std::move(scene), {extent, samples});
        if (!made) { // the test cannot go on without it
            std::fprintf(stderr, "%s\n", to_string(made.error()).c_str());
            std::abort();
        }
        return *std::move(made);
    }
    Renderer renderer(const std::string& text, Extent extent,
                      image::SampleType samples = image::SampleType::f32) const {
        return renderer(scene_of(text), extent, samples);
    }
    /// One that draws a picture again although it has it.
    Renderer diligent_renderer(const std::string& text, Extent extent, image::SampleType samples) const {
        auto made = Renderer::create(scene_of(text),
                                     {.extent = extent, .samples = samples, .extras = {.unchanged = true}});
        EXPECT_TRUE(made) << to_string(made.error());
        return *std::move(made);
    }
    static image::Image frame(Renderer& renderer, const FrameInputs& inputs = {}) {
        renderer.draw(inputs);
        return renderer.read_back();
    }

    /// A scene that puts each expression of type float into the red of a pixel of its own.
    static std::string telling(const std::vector<std::string>& expressions, const std::string& before = {}) {
        std::string text = before + "\nvoid mainImage(out vec4 c, in vec2 p) {\n    c = vec4(0.0);\n";
        for (size_t i = 0; i < expressions.size(); ++i)
            text += fmt::format("    if (int(p.x) == {}) c.r = {};\n", i, expressions[i]);
        return text + "}\n";
    }
    static std::vector<float> reds(const image::Image& image, size_t count) {
        std::vector<float> values;
        for (size_t i = 0; i < count; ++i)
            values.push_back(floats_at(image, int(i), 0)[0]);
        return values;
    }
    /// The values of the expressions, bit by bit as the shader has them.
    std::vector<float> told(const std::vector<std::string>& expressions, const FrameInputs& inputs = {},
                            const std::string& before = {}, Extent extent = {64, 1}) const {
        Renderer telling_renderer = renderer(telling(expressions, before), extent);
        return reds(frame(telling_renderer, inputs), expressions.size());
    }

private:
    TemporaryFolder folder_;
};

} // namespace tidemark::render
