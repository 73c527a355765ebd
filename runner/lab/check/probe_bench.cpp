#include "lab/check/probe_bench.hpp"

#include "glsl/hit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tidemark::lab {

ProbeBench::ProbeBench(const scene::Scene& scene, Promises promises, DrawElsewhere with_one_thread)
    : scene_(scene), hit_scene_(glsl::hit_scene(scene)), promises_(std::move(promises)),
      with_one_thread_(std::move(with_one_thread)) {}

/// What stands in the text is compiled; knobs are turned.
Result<render::Renderer*> ProbeBench::renderer(const FrameState& state, Entry entry,
                                               glsl::Precision precision) {
    std::string key = fmt::format("{} {}", int(entry), int(precision));
    for (const std::string& channel : state.channels)
        key += " " + channel;
    for (const Setting& setting : state.definitions)
        key += fmt::format(" {}={}", setting.name, setting.value);
    auto set = in_state(entry == Entry::hit ? *hit_scene_ : scene_, state);
    if (!set)
        return fail(std::move(set.error()));
    std::vector<scene::Knob> knobs = set->knobs;
    auto found = renderers_.find(key);
    if (found == renderers_.end()) {
        auto made = render::Renderer::create(
            *std::move(set), {.extent = state.extent,
                              .samples = image::SampleType::f32,
                              .precision = precision,
                              .specialise = glsl::Specialise::unreachable,
                              .extras = {.unchanged = true}}); // a probe asks whether a drawing repeats
        if (!made)
            return fail(std::move(made.error()));
        found = renderers_.emplace(std::move(key), *std::move(made)).first;
    }
    render::Renderer& renderer = found->second;
    renderer.turn(std::move(knobs));
    if (renderer.extent() != state.extent)
        if (auto resized = renderer.resize(state.extent); !resized)
            return fail(std::move(resized.error()));
    return &renderer;
}

Result<render::PassPreview> ProbeBench::preview(const FrameState& state, size_t pass) {
    auto made = renderer(state, Entry::picture, glsl::Precision::single);
    if (!made)
        return fail(std::move(made.error()));
    return render::FrameStepper(**made, state, first_frame_of(state)).preview(state.frame, pass);
}

Result<const render::Renderer*> ProbeBench::compiled() {
    return renderer(plain_state(), Entry::picture, glsl::Precision::single);
}

Result<render::Renderer*> ProbeBench::drawn(const FrameState& state, Entry entry, glsl::Precision precision) {
    auto made = renderer(state, entry, precision);
    if (made)
        render::FrameStepper(**made, state, first_frame_of(state)).draw(state.frame);
    return made;
}

Result<image::Image> ProbeBench::picture(const FrameState& state, glsl::Precision precision) {
    auto renderer = drawn(state, Entry::picture, precision);
    if (!renderer)
        return fail(std::move(renderer.error()));
    return image::without_alpha((*renderer)->read_back());
}

Result<image::Image> ProbeBench::fresh_picture(const FrameState& state) {
    renderers_.clear();
    return picture(state);
}

Result<std::vector<PassPicture>> ProbeBench::passes(const FrameState& state) {
    auto renderer = drawn(state, Entry::picture, glsl::Precision::single);
    if (!renderer)
        return fail(std::move(renderer.error()));
    return read_back(**renderer);
}

std::vector<PassPicture> ProbeBench::read_back(render::Renderer& renderer) const {
    std::vector<PassPicture> pictures;
    for (const render::PlannedPass& planned : renderer.plan().passes) {
        const scene::Pass& pass = scene_.passes[planned.pass];
        if (pass.kind != scene::PassKind::cubemap)
            pictures.push_back({pass.name, renderer.read_back(planned.pass)});
    }
    return pictures;
}

Result<bool> ProbeBench::has_feedback() {
    const auto made = compiled();
    if (!made)
        return fail(made.error());
    return (*made)->plan().feedback;
}

Result<void> ProbeBench::step(const See& see) {
    const auto made = renderer(plain_state(), Entry::picture, glsl::Precision::single);
    if (!made)
        return fail(made.error());
    FrameState at{.extent = k_probe_extent};
    for (render::FrameStepper stepper(**made, at);; ++at.frame) {
        stepper.draw(at.frame);
        if (!see(at, read_back(**made)))
            return {};
    }
}

bool ProbeBench::has_hits() {
    if (hit_scene_ && !std::exchange(hits_tried_, true))
        if (auto made = renderer(plain_state(), Entry::hit, glsl::Precision::single); !made) {
            if (!made.error().diagnostics.empty()) { // of which the first says it
                made.error().message.clear();
                made.error().diagnostics.resize(1);
            }
            hit_problem_ = to_string(made.error());
            hit_scene_.reset();
        }
    return hit_scene_.has_value();
}

std::string ProbeBench::see_bounds() const {
    if (explored_)
        for (const Outside& outside : explored_->outside)
            if (outside.bound)
                return "; see bounds: " + outside.sentence;
    return {};
}

Result<Hits> ProbeBench::hits(const FrameState& state, glsl::Precision precision) {
    auto renderer = drawn(state, Entry::hit, precision);
    if (!renderer)
        return fail(std::move(renderer.error()));
    return hits_of((*renderer)->read_back());
}

Result<std::vector<glsl::KeptHash>> ProbeBench::hashes() {
    auto made = renderer(plain_state(), Entry::picture, glsl::Precision::promoted);
    if (!made)
        return fail(std::move(made.error()));
    std::vector<glsl::KeptHash> all;
    for (const render::PlannedPass& planned : (*made)->plan().passes)
        for (const glsl::KeptHash& hash : (*made)->kept_hashes(planned.pass))
            all.push_back(hash);
    return all;
}

} // namespace tidemark::lab
