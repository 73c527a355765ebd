// Every folder of tests/cases/conformance is a test: a scene, and the pixels that ShaderToy's rules make of
// it, worked out without a GPU. Its README says how to add one.
#include "base/file.hpp"
#include "gl_test.hpp"
#include "render/mouse.hpp"
#include "render/sound_renderer.hpp"
#include "scene/load_scene.hpp"
#include "scene/overrides.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace tidemark::render {
namespace {

using Json = nlohmann::json;
using image::Image;
using image::SampleType;

const fs::path k_cases = fs::path(TIDEMARK_SOURCE_DIR) / "tests/cases/conformance";

std::vector<std::string> case_names() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(k_cases))
        if (entry.is_directory())
            names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// What a frame sees besides its number: a date, and what the mouse did before it.
FrameInputs inputs_of(const Json& frame, Mouse& mouse, Keyboard& keyboard) {
    FrameInputs inputs = inputs_of_frame(frame.value("frame", 0), frame.value("fps", 60.0));
    const Json events = frame.value("mouse", Json::array());
    for (const Json& event : events) {
        const std::string what = event.at(0);
        if (what == "press")
            mouse.press(event.at(1), event.at(2));
        else if (what == "move")
            mouse.move(event.at(1), event.at(2));
        else if (what == "release")
            mouse.release();
        else
            ADD_FAILURE() << "unknown mouse event " << what;
    }
    inputs.mouse = mouse.uniform();
    for (const Json& event : frame.value("keys", Json::array())) {
        const std::string what = event.at(0);
        if (what == "press")
            keyboard.press(event.at(1));
        else
            keyboard.release(event.at(1));
    }
    inputs.keyboard = keyboard.texels();
    if (frame.contains("date")) {
        const auto date = parse_date(frame.at("date").get<std::string>());
        EXPECT_TRUE(date) << to_string(date.error());
        inputs.date = date.value_or(Date{});
    }
    return inputs;
}

/// One expected pixel: red, green, blue and, where it is given, alpha.
void expect_pixel(const Image& image, int x, int y, const Json& wanted, double tolerance) {
    for (size_t channel = 0; channel < wanted.size(); ++channel) {
        const double got = image.type == SampleType::u8 ? bytes_at(image, x, y)[channel]
                                                        : double(floats_at(image, x, y)[channel]);
        const double want = image.type == SampleType::u8 ? wanted[channel].get<double>()
                                                         : double(wanted[channel].get<float>());
        ASSERT_LE(std::abs(got - want), tolerance)
            << "pixel " << x << ',' << y << " channel " << channel << " is " << got << ", not " << want;
    }
}

void expect_frame(const Image& image, const Json& frame) {
    const double tolerance = frame.value("tolerance", 0.0);
    if (frame.contains("everywhere")) {
        for (int y = 0; y < image.extent.height; ++y)
            for (int x = 0; x < image.extent.width; ++x)
                ASSERT_NO_FATAL_FAILURE(expect_pixel(image, x, y, frame.at("everywhere"), tolerance));
    }
    const Json pixels = frame.value("pixels", Json::array());
    for (const Json& pixel : pixels)
        ASSERT_NO_FATAL_FAILURE(expect_pixel(image, pixel.at(0), pixel.at(1), pixel.at(2), tolerance));
}

/// Samples of the Sound pass: [number, left, right] in 16 bits.
void expect_sound(const scene::Scene& scene, const Json& samples) {
    auto renderer = SoundRenderer::create(scene, Date{});
    ASSERT_TRUE(renderer) << to_string(renderer.error());
    for (const Json& sample : samples) {
        const int number = sample.at(0);
        const int row = number - number % SoundRenderer::samples_in(1);
        const std::vector<int16_t> drawn = renderer->draw_rows(row, 1);
        EXPECT_EQ(drawn[2 * size_t(number - row)], sample.at(1).get<int>()) << "left of " << number;
        EXPECT_EQ(drawn[2 * size_t(number - row) + 1], sample.at(2).get<int>()) << "right of " << number;
        const int block = number - number % SoundRenderer::block_samples();
        EXPECT_EQ(renderer->draw(block)[2 * size_t(number - block)], sample.at(1).get<int>()) << number;
    }
}

class Conformance : public testing::TestWithParam<std::string> {
protected:
    /// Size and samples are the case's.
    void expect_pixels_of_the_convention(RenderOptions options) const;
};

void Conformance::expect_pixels_of_the_convention(RenderOptions options) const {
    const fs::path folder = k_cases / GetParam();
    const auto text = read_file(folder / "expected.json");
    ASSERT_TRUE(text) << to_string(text.error());
    const Json expected = Json::parse(*text);
    SCOPED_TRACE(expected.at("convention").get<std::string>());

    const bool bare = fs::exists(folder / "scene.glsl");
    const bool project = fs::exists(folder / "project.json");
    auto scene = scene::load_scene(bare ? folder / "scene.glsl" : project ? folder / "project.json" : folder);
    ASSERT_TRUE(scene) << to_string(scene.error());
    if (expected.contains("sound"))
        expect_sound(*scene, expected.at("sound"));
    const Json channels = expected.value("channels", Json::object());
    for (const auto& [channel, what] : channels.items()) {
        const auto set = scene::override_channel(*scene, channel + "=" + what.get<std::string>());
        ASSERT_TRUE(set) << to_string(set.error());
    }
    const Json& size = expected.at("size");
    options.extent = {size.at(0), size.at(1)};
    options.samples = expected.value("target", "bytes") == "floats" ? SampleType::f32 : SampleType::u8;
    auto renderer = Renderer::create(*std::move(scene), options);
    ASSERT_TRUE(renderer) << to_string(renderer.error());

    Mouse mouse;
    Keyboard keyboard;
    const Json frames = expected.value("frames", Json::array());
    ASSERT_FALSE(frames.empty() && !expected.contains("sound"));
    for (const Json& frame : frames) {
        SCOPED_TRACE(frame.dump());
        if (frame.contains("resize")) {
            ASSERT_TRUE(renderer->resize({frame.at("resize").at(0), frame.at("resize").at(1)}));
        }
        if (frame.value("reset", false))
            renderer->reset();
        renderer->draw(inputs_of(frame, mouse, keyboard));
        mouse.frame_drawn();
        keyboard.frame_drawn();
        ASSERT_NO_FATAL_FAILURE(expect_frame(renderer->read_back(), frame));
    }
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST_P(Conformance, pixels_are_those_of_the_convention) {
    expect_pixels_of_the_convention({});
}

TEST_P(Conformance, and_in_double_precision_too) {
    expect_pixels_of_the_convention({.precision = glsl::Precision::promoted});
}

TEST_P(Conformance, and_when_nothing_is_left_out) {
    expect_pixels_of_the_convention({.extras = {.passes = true,
                                                .channels = true,
                                                .mipmaps = true,
                                                .second_textures = true,
                                                .uniforms = true,
                                                .unchanged = true}});
}

TEST_P(Conformance, and_without_what_main_does_not_need) {
    expect_pixels_of_the_convention({.specialise = glsl::Specialise::unreachable});
}

INSTANTIATE_TEST_SUITE_P(cases, Conformance, testing::ValuesIn(case_names()),
                         [](const auto& chosen) { return chosen.param; });

} // namespace
} // namespace tidemark::render
