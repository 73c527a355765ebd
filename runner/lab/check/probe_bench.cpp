#include "lab/check/probe_bench.hpp"

#include "base/try.hpp"
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
    auto set = TRY(in_state(entry == Entry::hit ? *hit_scene_ : scene_, state));
    std::vector<scene::Knob> knobs = set.knobs;
    auto found = renderers_.find(key);
    if (found == renderers_.end()) {
        auto made = render::Renderer::create(
            std::move(set), {.extent = state.extent,
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
        TRY(renderer.resize(state.extent));
    return &renderer;
}

Result<render::PassPreview> ProbeBench::preview(const FrameState& state, size_t pass) {
    auto made = TRY(renderer(state, Entry::picture, glsl::Precision::single));
    return render::FrameStepper(*made, state, first_frame_of(state)).preview(state.frame, pass);
}

Result<const render::Renderer*> ProbeBench::compiled() {
    return renderer(plain_state(), Entry::picture, glsl::Precision::single);
}

Result<const render::Renderer*> ProbeBench::drawn(const FrameState& state) {
    return drawn(state, Entry::picture, glsl::Precision::single);
}

Result<render::Renderer*> ProbeBench::drawn(const FrameState& state, Entry entry, glsl::Precision precision) {
    auto made = renderer(state, entry, precision);
    if (made)
        render::FrameStepper(**made, state, first_frame_of(state)).draw(state.frame);
    return made;
}

Result<image::Image> ProbeBench::picture(const FrameState& state, glsl::Precision precision) {
    auto renderer = TRY(drawn(state, Entry::picture, precision));
    return image::without_alpha((renderer)->read_back());
}

Result<image::Image> ProbeBench::fresh_picture(const FrameState& state) {
    renderers_.clear();
    return picture(state);
}

Result<std::vector<PassPicture>> ProbeBench::passes(const FrameState& state) {
    auto renderer = TRY(drawn(state, Entry::picture, glsl::Precision::single));
    return read_back(*renderer);
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
    const auto made = TRY(compiled());
    return (made)->plan().feedback;
}

Result<void> ProbeBench::step(const See& see) {
    const auto made = TRY(renderer(plain_state(), Entry::picture, glsl::Precision::single));
    FrameState at{.extent = k_probe_extent};
    for (render::FrameStepper stepper(*made, at);; ++at.frame) {
        stepper.draw(at.frame);
        if (!see(at, read_back(*made)))
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
    auto renderer = TRY(drawn(state, Entry::hit, precision));
    return hits_of((renderer)->read_back());
}

Result<std::vector<glsl::KeptHash>> ProbeBench::hashes() {
    auto made = TRY(renderer(plain_state(), Entry::picture, glsl::Precision::promoted));
    std::vector<glsl::KeptHash> all;
    for (const render::PlannedPass& planned : (made)->plan().passes)
        for (const glsl::KeptHash& hash : (made)->kept_hashes(planned.pass))
            all.push_back(hash);
    return all;
}

} // namespace tidemark::lab
