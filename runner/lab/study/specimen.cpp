#include "lab/study/specimen.hpp"

#include "base/try.hpp"
#include "gl/elapsed_time.hpp"
#include "glsl/hit.hpp"

#include <GL/glcorearb.h>
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace tidemark::lab {
namespace {

/// Draws the frame of the view into the renderer's target.
void draw(render::Renderer& renderer, const View& view) {
    const render::FrameState state = state_of(view, renderer.extent());
    render::FrameStepper(renderer, state).draw(state.frame);
}

} // namespace

Result<Specimen> Specimen::create(const scene::Scene& scene, const Recipe& recipe, Extent extent,
                                  HitSource hits) {
    auto set = TRY(with(scene, recipe.settings));
    Specimen specimen;
    specimen.extent_ = extent;
    specimen.precision_ = recipe.precision;
    if (hits != HitSource::none)
        specimen.hit_scene_ = glsl::hit_scene(set);
    if (!specimen.has_hits() && hits == HitSource::main_hit_or_march)
        TRY(specimen.record(set));
    const Stopwatch watch;
    auto renderer = render::Renderer::create(
        std::move(set), {.extent = extent,
                         .samples = image::SampleType::f32,
                         .precision = recipe.precision,
                         .specialise = glsl::Specialise::unreachable,
                         .extras = {.unchanged = true}}); // so that drawing always costs its full time
    if (!renderer)
        return fail(std::move(renderer.error()));
    specimen.compile_milliseconds_ = watch.elapsed().wall;
    specimen.renderer_ = *std::move(renderer);
    return specimen;
}

void Specimen::turn(const std::vector<scene::Knob>& knobs) {
    renderer_->turn(knobs);
    if (hit_scene_)
        hit_scene_->knobs = knobs;
    if (hit_renderer_)
        hit_renderer_->turn(knobs);
}

std::vector<image::Image> Specimen::pictures(const std::vector<View>& views) {
    std::vector<size_t> order(views.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::stable_sort(order, {}, [&](size_t i) { return views[i].state.frame; });
    std::vector<image::Image> pictures(views.size());
    render::FrameState now;
    std::optional<render::FrameStepper> stepper;
    for (const size_t i : order) {
        const render::FrameState state = state_of(views[i], extent_);
        const bool goes_on = stepper && state.is_in_run_of(now);
        now = state;
        if (!goes_on)
            stepper.emplace(*renderer_, [&now](int frame) { return now.at_frame(frame); });
        const Stopwatch watch;
        stepper->draw(state.frame);
        glFinish();
        if (!drawn_)
            first_draw_milliseconds_ = watch.elapsed().wall;
        drawn_ = true;
        pictures[i] = image::without_alpha(renderer_->read_back());
    }
    return pictures;
}

image::Image Specimen::picture(const View& view) {
    return std::move(pictures({view}).front());
}

Result<void> Specimen::record(const scene::Scene& set) {
    recorded_ = TRY(PassFunction::create(set, set.image()));
    hit_scene_ = TRY(record_hits(set, *recorded_)).scene;
    return {};
}

/// Compares the recording with the text on the CPU, which computes in float.
Result<void> Specimen::check_recording(const View& view) {
    if (!recorded_ || precision_ != glsl::Precision::single)
        return {};
    const render::FrameState state = state_of(view, extent_);
    const std::string why = refusal_of(lab::check_recording(*renderer_, *hit_renderer_, *recorded_, state));
    return why.empty() ? Result<void>() : fail(ErrorCode::load, why);
}

Result<Hits> Specimen::hits(const View& view) {
    if (!hit_renderer_) {
        hit_renderer_ = TRY(render::Renderer::create(
            *hit_scene_, {extent_, image::SampleType::f32, "", precision_, glsl::Specialise::unreachable}));
        TRY(check_recording(view));
    }
    draw(*hit_renderer_, view);
    return hits_of(hit_renderer_->read_back());
}

Result<std::vector<Hits>> Specimen::hits(const std::vector<View>& views) {
    std::vector<Hits> all;
    for (const View& view : views) {
        auto one = TRY(hits(view));
        all.push_back(std::move(one));
    }
    return all;
}

std::vector<std::string> Specimen::kept_hashes() const {
    std::set<std::string> names;
    for (const render::PlannedPass& planned : renderer_->plan().passes)
        for (const glsl::KeptHash& hash : renderer_->kept_hashes(planned.pass))
            names.insert(hash.function.empty() ? fmt::format("line {}", hash.where.line) : hash.function);
    return {names.begin(), names.end()};
}

Cost Specimen::time(const View& view, bool ask_gpu) {
    const render::FrameInputs inputs = inputs_of(state_of(view, extent_));
    glFinish();
    const Stopwatch watch;
    std::optional<gl::ElapsedTime> gpu;
    if (ask_gpu)
        gpu.emplace();
    renderer_->draw(inputs);
    if (gpu)
        gpu->stop();
    glFinish();
    Cost cost{watch.elapsed(), {}};
    if (gpu)
        cost.gpu = gpu->milliseconds();
    return cost;
}

} // namespace tidemark::lab
