#include "base/error.hpp"
#include "base/file.hpp"
#include "base/folders.hpp"
#include "lab/device_check.hpp"
#include "render/frame_state.hpp"
#include "render/renderer.hpp"
#include "render/sound_renderer.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

namespace fs = std::filesystem;
using ExpectedJson = nlohmann::json;
using image::Image;
using image::SampleType;
using render::Renderer;

Result<ExpectedJson> read_expected(const fs::path& project) {
    const auto text = TRY(read_file(project / "expected.json"));
    auto expected = ExpectedJson::parse(text, nullptr, false);
    if (!expected.is_object())
        return fail(ErrorCode::load,
                    fmt::format("'{}' is not a JSON object", (project / "expected.json").string()));
    return expected;
}

/// Mouse and keyboard, moved by the events before each frame.
struct Hands {
    render::Mouse mouse;
    render::Keyboard keyboard;

    void do_before(const ExpectedJson& frame) {
        for (const ExpectedJson& event : frame.value("mouse", ExpectedJson::array())) {
            const std::string what = event.at(0);
            if (what == "press")
                mouse.press(event.at(1), event.at(2));
            else if (what == "move")
                mouse.move(event.at(1), event.at(2));
            else
                mouse.release();
        }
        for (const ExpectedJson& event : frame.value("keys", ExpectedJson::array())) {
            if (event.at(0) == "press")
                keyboard.press(event.at(1));
            else
                keyboard.release(event.at(1));
        }
    }
    void frame_drawn() {
        mouse.frame_drawn();
        keyboard.frame_drawn();
    }
};

Result<render::FrameInputs> inputs_of_expected(const ExpectedJson& frame, const Hands& hands) {
    render::FrameInputs inputs = render::inputs_of_frame(frame.value("frame", 0), frame.value("fps", 60.0));
    inputs.mouse = hands.mouse.uniform();
    inputs.keyboard = hands.keyboard.texels();
    if (frame.contains("date"))
        inputs.date = TRY(render::parse_date(frame.at("date").get<std::string>()));
    return inputs;
}

/// Checks one pixel: red, green, blue and, if given, alpha.
Result<void> pixel_is(const Image& image, int x, int y, const ExpectedJson& wanted, double tolerance) {
    const size_t at = 4 * (size_t(y) * size_t(image.extent.width) + size_t(x));
    for (size_t channel = 0; channel < wanted.size(); ++channel) {
        const bool bytes = image.type == SampleType::u8;
        const double got = bytes ? image.u8()[at + channel] : double(image.f32()[at + channel]);
        const double want = bytes ? wanted[channel].get<double>() : double(wanted[channel].get<float>());
        if (!(std::abs(got - want) <= tolerance))
            return fail(ErrorCode::check_failed,
                        fmt::format("pixel {},{} channel {} is {}, not {}", x, y, channel, got, want));
    }
    return {};
}

Result<void> picture_is(const Image& image, const ExpectedJson& frame) {
    const double tolerance = frame.value("tolerance", 0.0);
    for (int y = 0; frame.contains("everywhere") && y < image.extent.height; ++y)
        for (int x = 0; x < image.extent.width; ++x)
            TRY(pixel_is(image, x, y, frame.at("everywhere"), tolerance));
    for (const ExpectedJson& pixel : frame.value("pixels", ExpectedJson::array()))
        TRY(pixel_is(image, pixel.at(0), pixel.at(1), pixel.at(2), tolerance));
    return {};
}

/// Checks samples of the Sound pass, [number, left, right] in 16 bits, in a row drawn alone and in its block.
Result<void> sound_is(const scene::Scene& scene, const ExpectedJson& samples) {
    auto renderer = TRY(render::SoundRenderer::create(scene, render::Date{}));
    for (const ExpectedJson& sample : samples) {
        const int number = sample.at(0);
        const int row = number - number % render::SoundRenderer::samples_in(1);
        const int block = number - number % render::SoundRenderer::block_samples();
        const std::vector<int16_t> of_row = renderer.draw_rows(row, 1);
        const auto of_block = renderer.draw(block);
        for (size_t side = 0; side < 2; ++side) {
            const int want = sample.at(1 + side);
            for (const int got : {int(of_row[2 * size_t(number - row) + side]),
                                  int(of_block[2 * size_t(number - block) + side])})
                if (got != want)
                    return fail(ErrorCode::check_failed,
                                fmt::format("sample {} of the sound is {}, not {}", number, got, want));
        }
    }
    return {};
}

Result<void> frames_are(Renderer& renderer, const ExpectedJson& frames) {
    Hands hands;
    for (const ExpectedJson& frame : frames) {
        if (frame.contains("resize"))
            TRY(renderer.resize({frame.at("resize").at(0), frame.at("resize").at(1)}));
        if (frame.value("reset", false))
            renderer.reset();
        hands.do_before(frame);
        renderer.draw(TRY(inputs_of_expected(frame, hands)));
        hands.frame_drawn();
        TRY(picture_is(renderer.read_back(), frame).map_error([&](Error error) {
            error.message += fmt::format(" (in frame {})", frame.value("frame", 0));
            return error;
        }));
    }
    return {};
}

Result<scene::Scene> load_project(const fs::path& project) {
    for (const char* file : {"scene.glsl", "project.json"})
        if (std::error_code ignored; fs::exists(project / file, ignored))
            return scene::load_scene(project / file);
    return scene::load_scene(project);
}

Result<void> is_drawn_as_expected(const fs::path& project, render::RenderOptions options) {
    const ExpectedJson expected = TRY(read_expected(project));
    scene::Scene scene = TRY(load_project(project));
    if (expected.contains("sound"))
        TRY(sound_is(scene, expected.at("sound")));
    const ExpectedJson channels = expected.value("channels", ExpectedJson::object());
    for (const auto& [channel, what] : channels.items())
        TRY(scene::override_channel(scene, channel + "=" + what.get<std::string>()));
    options.extent = {expected.at("size").at(0), expected.at("size").at(1)};
    options.samples = expected.value("target", "bytes") == "floats" ? SampleType::f32 : SampleType::u8;
    auto renderer = TRY(Renderer::create(std::move(scene), options));
    const ExpectedJson frames = expected.value("frames", ExpectedJson::array());
    if (frames.empty() && !expected.contains("sound"))
        return fail(ErrorCode::load,
                    fmt::format("'{}' states no expected pixels or sound", project.string()));
    return frames_are(renderer, frames);
}

} // namespace

std::vector<fs::path> conformance_projects(const fs::path& folder) {
    std::vector<fs::path> projects;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (entry.is_directory(ignored))
            projects.push_back(entry.path());
    std::ranges::sort(projects);
    return projects;
}

Result<void> conforms(const fs::path& project, render::RenderOptions options) {
    try {
        return is_drawn_as_expected(project, std::move(options));
    } catch (const ExpectedJson::exception& error) { // the file does not have the documented format
        return fail(ErrorCode::load,
                    fmt::format("'{}': {}", (project / "expected.json").string(), error.what()));
    }
}

Result<DeviceAnswer> ask_conformance() {
    const auto projects = conformance_projects(conformance_folder());
    if (projects.empty())
        return DeviceAnswer{Verdict::warn,
                            fmt::format("not run: no projects in '{}'", conformance_folder().string())};
    std::vector<std::string> others;
    for (const auto& project : projects)
        if (const auto drawn = conforms(project); !drawn)
            others.push_back(fmt::format("{}: {}", project.filename().string(), to_string(drawn.error())));
    if (!others.empty())
        return DeviceAnswer{Verdict::fail,
                            fmt::format("{} of {} projects do not follow ShaderToy's rules: {}",
                                        others.size(), projects.size(), fmt::join(others, "; "))};
    return DeviceAnswer{Verdict::pass,
                        fmt::format("{} projects give the pixels and sounds that ShaderToy's rules require",
                                    projects.size())};
}

} // namespace tidemark::lab
