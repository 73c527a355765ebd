// Measures what specialising a scene's text changes: the bytes of frames 0 and N, and the CPU time of
// compiling, the first draw and a frame, with the levels in turn in each round. Prints one line of JSON for
// each scene.
//
//     tidemark_specialised [--size WxH] [--frame N] [--rounds N] [--bytes-kept] SCENE...
//
// --bytes-kept: without the level that makes knobs constants.
#include "base/measurement.hpp"
#include "bench_options.hpp"
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
using glsl::Specialise;
using Json = nlohmann::ordered_json;

struct Settings {
    Extent extent{64, 36};
    int frame = 30;
    int rounds = 3;
    size_t levels = 4;
};

struct Level {
    Specialise how;
    const char* name;
};
constexpr Level k_levels[] = {{Specialise::nothing, "plain"},
                              {Specialise::unreachable, "unreachable"},
                              {Specialise::invariant_uniforms, "settled"},
                              {Specialise::constants, "constants"}};

template <class Work>
double cost_of(const Work& work) {
    glFinish();
    const lab::Stopwatch watch;
    work();
    glFinish();
    return watch.elapsed().cpu;
}

/// Returns the pictures of all passes.
std::vector<image::Image> everything(const render::Renderer& renderer) {
    std::vector<image::Image> images;
    for (const render::PlannedPass& planned : renderer.plan().passes) {
        const bool cube = renderer.scene().passes[planned.pass].kind == scene::PassKind::cubemap;
        for (int face = 0; face < (cube ? 6 : 1); ++face)
            images.push_back(renderer.read_floats(planned.pass, face));
    }
    return images;
}

Json json_of(const render::Renderer& renderer) {
    Json json = {{"lines", 0}, {"hoisted", 0}, {"constants", 0}};
    for (const render::PlannedPass& planned : renderer.plan().passes) {
        const glsl::LeftOut& left_out = renderer.left_out(planned.pass);
        json["lines"] = json["lines"].get<int>() + left_out.lines;
        json["hoisted"] = json["hoisted"].get<int>() + left_out.loop_invariants;
        json["constants"] = json["constants"].get<int>() + left_out.constants;
        if (!left_out.anything())
            json["kept_whole"] = left_out.kept_whole;
    }
    return json;
}

/// Draws the frames that are compared; the cost of each later draw of the last goes to `frames`.
struct Subject {
    std::optional<render::Renderer> renderer;
    std::vector<std::vector<image::Image>> pictures;
    double compile = 0;
    double first = 0;
    std::vector<double> frames;
};

Json measure(const std::string& file, const Settings& settings) {
    Json line = {{"scene", file}};
    const auto scene = scene::load_scene(file);
    if (!scene)
        return line["error"] = to_string(scene.error()), line;
    std::vector<Subject> subjects(settings.levels);
    for (size_t i = 0; i < subjects.size(); ++i) {
        Subject& subject = subjects[i];
        std::string error;
        subject.compile = cost_of([&] {
            auto made = render::Renderer::create(*scene, {.extent = settings.extent,
                                                          .samples = image::SampleType::f32,
                                                          .specialise = k_levels[i].how});
            if (made)
                subject.renderer = *std::move(made);
            else
                error = to_string(made.error());
        });
        if (!subject.renderer)
            return line["error"] = std::string(k_levels[i].name) + ": " + error, line;
        subject.first = cost_of([&] { subject.renderer->draw(render::inputs_of_frame(0, 60)); });
        subject.pictures.push_back(everything(*subject.renderer));
        const bool steps = subject.renderer->plan().feedback;
        for (int frame = steps ? 1 : settings.frame; frame <= settings.frame; ++frame)
            subject.renderer->draw(render::inputs_of_frame(frame, 60));
        subject.pictures.push_back(everything(*subject.renderer));
    }
    for (int round = 0; round < settings.rounds; ++round)
        for (Subject& subject : subjects)
            subject.frames.push_back(cost_of(
                [&] { subject.renderer->draw(render::inputs_of_frame(settings.frame + round, 60)); }));
    for (size_t i = 0; i < subjects.size(); ++i) {
        Subject& subject = subjects[i];
        std::sort(subject.frames.begin(), subject.frames.end());
        Json level = json_of(*subject.renderer);
        level["compile_ms"] = subject.compile;
        level["first_draw_ms"] = subject.first;
        level["frame_ms"] = subject.frames[subject.frames.size() / 2];
        level["same_bytes"] = subject.pictures == subjects[0].pictures;
        line[k_levels[i].name] = level;
    }
    return line;
}

} // namespace

int main(int count, char** arguments) {
    Settings settings;
    const auto files = bench::files_of(count, arguments, [&](const std::string& word, const char* next) {
        if (word == "--bytes-kept") {
            settings.levels = 3;
            return 1;
        }
        if (word == "--size" && next)
            bench::read_size(next, settings.extent);
        else if ((word == "--frame" || word == "--rounds") && next)
            (word == "--frame" ? settings.frame : settings.rounds) = std::max(1, std::atoi(next));
        else
            return 0;
        return 2;
    });
    const auto context = bench::context_or_exit();
    for (const std::string& file : files) {
        fmt::print("{}\n", measure(file, settings).dump());
        std::fflush(stdout);
    }
    return 0;
}
