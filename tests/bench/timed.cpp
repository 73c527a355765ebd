// Measures the CPU time of a frame of several scenes, in turn in each round, so that they can be compared
// with each other. Prints one line of JSON for each scene.
//
//     tidemark_timed [--size WxH] [--time S] [--rounds N] [--tiles SIDE] SCENE...
//
// --tiles: also the time of each tile of Image, rows from the bottom, for scenes whose Image can be drawn
// again.
#include "base/measurement.hpp"
#include "bench_options.hpp"
#include "lab/probe_inputs.hpp"
#include "render/frame_stepper.hpp"
#include "render/renderer.hpp"
#include "scene/load_scene.hpp"

#include <GL/glcorearb.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace tidemark;
using Json = nlohmann::ordered_json;

struct Settings {
    Extent extent{320, 180};
    double time = 10;
    int rounds = 9;
    int tile = 0; ///< side; 0: no tiles
};

/// A scene that is drawn again and again at one moment.
struct Subject {
    Json line;
    std::optional<render::Renderer> renderer;
    render::FrameInputs inputs;
    std::vector<double> times;
    std::vector<std::vector<double>> tiles;

    Subject(const std::string& file, const Settings& settings) : line{{"scene", file}} {
        auto scene = scene::load_scene(file);
        if (!scene) {
            line["error"] = to_string(scene.error());
            return;
        }
        render::RenderOptions options{.extent = settings.extent,
                                      .samples = image::SampleType::f32,
                                      .specialise = glsl::Specialise::unreachable};
        options.extras.unchanged = true;
        auto made = render::Renderer::create(*std::move(scene), options);
        if (!made) {
            line["error"] = to_string(made.error());
            return;
        }
        renderer = *std::move(made);
        const render::FrameState state = lab::state_at(settings.time, settings.extent);
        inputs = inputs_of(state);
        render::FrameStepper(*renderer, state, lab::first_frame_of(state)).draw(state.frame);
        glFinish();
    }

    void draw() {
        const lab::Stopwatch watch;
        renderer->draw(inputs);
        glFinish();
        times.push_back(watch.elapsed().cpu);
    }

    void draw_tiles(const Settings& settings, const gl::RenderTarget& target) {
        if (!renderer->can_draw_again())
            return;
        std::vector<double> round;
        glEnable(GL_SCISSOR_TEST);
        for (int y = 0; y < settings.extent.height; y += settings.tile)
            for (int x = 0; x < settings.extent.width; x += settings.tile) {
                glScissor(x, y, settings.tile, settings.tile);
                const lab::Stopwatch watch;
                renderer->draw_again(inputs, target);
                glFinish();
                round.push_back(watch.elapsed().cpu);
            }
        glDisable(GL_SCISSOR_TEST);
        tiles.push_back(std::move(round));
    }

    Json report() const {
        Json report = line;
        if (times.empty())
            return report;
        report["ms"] = lab::median(times);
        report["times"] = times;
        for (size_t i = 0; !tiles.empty() && i < tiles[0].size(); ++i) {
            std::vector<double> one;
            for (const auto& round : tiles)
                one.push_back(round[i]);
            report["tiles"].push_back(lab::median(one));
        }
        return report;
    }
};

} // namespace

int main(int count, char** arguments) {
    Settings settings;
    const auto files = bench::files_of(count, arguments, [&](const std::string& word, const char* next) {
        if (word == "--size" && next)
            bench::read_size(next, settings.extent);
        else if (word == "--time" && next)
            settings.time = std::atof(next);
        else if (word == "--rounds" && next)
            settings.rounds = std::max(1, std::atoi(next));
        else if (word == "--tiles" && next)
            settings.tile = std::max(1, std::atoi(next));
        else
            return 0;
        return 2;
    });
    const auto context = bench::context_or_exit();
    std::vector<Subject> subjects;
    for (const std::string& file : files)
        subjects.emplace_back(file, settings);
    const auto target = gl::make_render_target(gl::make_texture(settings.extent, GL_RGBA32F, 1));
    for (int round = 0; round < settings.rounds; ++round)
        for (Subject& subject : subjects)
            if (subject.renderer) {
                subject.draw();
                if (settings.tile > 0 && target)
                    subject.draw_tiles(settings, *target);
            }
    for (const Subject& subject : subjects)
        fmt::print("{}\n", subject.report().dump());
    return 0;
}
