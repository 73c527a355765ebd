#include "lab/specimen.hpp"

#include "glsl/hit.hpp"

#include <GL/glcorearb.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <set>

namespace tidemark::lab {
namespace {

/// The clock on the wall and the CPU time of all threads, read together.
struct Moment {
    std::chrono::steady_clock::time_point wall;
    double cpu; ///< milliseconds
};

Moment now() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto milliseconds = [](const timeval& t) {
        return double(t.tv_sec) * 1e3 + double(t.tv_usec) * 1e-3;
    };
    return {std::chrono::steady_clock::now(), milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime)};
}

Specimen::Cost between(const Moment& from, const Moment& to) {
    return {std::chrono::duration<double, std::milli>(to.wall - from.wall).count(), to.cpu - from.cpu};
}

/// Leaves the frame of the view in the renderer's target.
void draw(render::Renderer& renderer, const View& view) {
    const render::FrameInputs inputs = inputs_of(view, renderer.extent());
    if (renderer.plan().feedback) {
        renderer.reset();
        for (int frame = 0; frame < inputs.frame; ++frame) {
            render::FrameInputs before = render::inputs_of_frame(frame, inputs.frame_rate);
            before.mouse = inputs.mouse;
            before.camera = inputs.camera;
            renderer.draw(before);
        }
    }
    renderer.draw(inputs);
}

} // namespace

Result<Specimen> Specimen::create(const scene::Scene& scene, const Recipe& recipe, Extent extent) {
    auto set = with(scene, recipe.settings);
    if (!set)
        return fail(std::move(set.error()));
    Specimen specimen;
    specimen.extent_ = extent;
    specimen.precision_ = recipe.precision;
    specimen.hit_scene_ = glsl::hit_scene(*set);
    const Moment start = now();
    auto renderer =
        render::Renderer::create(*std::move(set), {extent, image::SampleType::f32, "", recipe.precision});
    if (!renderer)
        return fail(std::move(renderer.error()));
    specimen.compile_milliseconds_ = between(start, now()).wall;
    specimen.renderer_ = *std::move(renderer);
    return specimen;
}

image::Image Specimen::picture(const View& view) {
    const Moment start = now();
    draw(*renderer_, view);
    glFinish();
    if (!drawn_)
        first_draw_milliseconds_ = between(start, now()).wall;
    drawn_ = true;
    return image::without_alpha(renderer_->read_back());
}

Result<Hits> Specimen::hits(const View& view) {
    if (!hit_renderer_) {
        auto renderer =
            render::Renderer::create(*hit_scene_, {extent_, image::SampleType::f32, "", precision_});
        if (!renderer)
            return fail(std::move(renderer.error()));
        hit_renderer_ = *std::move(renderer);
    }
    draw(*hit_renderer_, view);
    return hits_of(hit_renderer_->read_back());
}

std::vector<std::string> Specimen::kept_hashes() const {
    std::set<std::string> names;
    for (const render::PlannedPass& planned : renderer_->plan().passes)
        for (const glsl::KeptHash& hash : renderer_->kept_hashes(planned.pass))
            names.insert(hash.function.empty() ? fmt::format("line {}", hash.where.line) : hash.function);
    return {names.begin(), names.end()};
}

Specimen::Cost Specimen::time(const View& view) {
    const render::FrameInputs inputs = inputs_of(view, extent_);
    glFinish();
    const Moment start = now();
    renderer_->draw(inputs);
    glFinish();
    return between(start, now());
}

} // namespace tidemark::lab
