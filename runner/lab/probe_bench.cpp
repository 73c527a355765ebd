#include "lab/probe_bench.hpp"

#include "base/error.hpp"
#include "shader/survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tidemark::lab {

ProbeBench::ProbeBench(const scene::Scene& scene, Promises promises, DrawElsewhere with_one_thread)
    : scene_(scene), promises_(std::move(promises)), with_one_thread_(std::move(with_one_thread)),
      has_main_hit_(glsl::hit_scene(scene).has_value()) {}

Result<scene::Scene> ProbeBench::scene_of(const FrameState& state, Entry entry) const {
    auto set = TRY(in_state(scene_, state));
    if (entry == Entry::picture)
        return set;
    if (entry == Entry::main_hit)
        return *glsl::hit_scene(set);
    const auto function = TRY(PassFunction::create(set, set.image()));
    return TRY(record_hits(set, function)).scene;
}

namespace {

/// Returns `knobs` with its first entries replaced by `values`.
std::vector<scene::Knob> turned(std::vector<scene::Knob> knobs, const std::vector<scene::Knob>& values) {
    std::ranges::copy(values, knobs.begin());
    return knobs;
}

} // namespace

namespace {

/// Returns the frames of the state's run. In double they have the iTime that floats have.
render::FrameStates states_of(const FrameState& state, glsl::Precision precision) {
    if (precision == glsl::Precision::single)
        return [state](int frame) { return state.at_frame(frame); };
    return [state](int frame) {
        FrameState at = state.at_frame(frame);
        at.time = double(float(at.seconds()));
        return at;
    };
}

} // namespace

/// Definitions and channels need a renderer of their own; knobs are only set.
Result<render::Renderer*> ProbeBench::renderer(const FrameState& state, Entry entry,
                                               glsl::Precision precision) {
    std::string key = fmt::format("{} {}", int(entry), int(precision));
    for (const std::string& channel : state.channels)
        key += " " + channel;
    for (const Setting& setting : state.definitions)
        key += fmt::format(" {}={}", setting.name, setting.value);
    auto found = renderers_.find(key);
    if (found == renderers_.end()) {
        auto set = TRY(scene_of(state, entry));
        auto made = render::Renderer::create(
            std::move(set), {.extent = state.extent,
                             .samples = image::SampleType::f32,
                             .precision = precision,
                             .specialise = glsl::Specialise::unreachable,
                             .extras = {.unchanged = true}}); // a probe checks whether a drawing repeats
        if (!made)
            return fail(std::move(made.error()));
        found = renderers_.emplace(std::move(key), *std::move(made)).first;
    }
    render::Renderer& renderer = found->second;
    const scene::Scene wanted = TRY(in_state(scene_, state));
    renderer.turn(turned(renderer.scene().knobs, wanted.knobs));
    if (renderer.extent() != state.extent)
        TRY(renderer.resize(state.extent));
    return &renderer;
}

Result<render::PassPreview> ProbeBench::preview(const FrameState& state, size_t pass, RunUp run_up) {
    auto made = TRY(renderer(state, Entry::picture, glsl::Precision::single));
    const int first = run_up == RunUp::drawn ? start_of(state) : state.frame;
    return render::FrameStepper(*made, state, first).preview(state.frame, pass);
}

Result<const render::Renderer*> ProbeBench::compiled() {
    return renderer(plain_state(), Entry::picture, glsl::Precision::single);
}

Result<const render::Renderer*> ProbeBench::drawn(const FrameState& state) {
    return drawn(state, Entry::picture, glsl::Precision::single);
}

Result<const render::Renderer*> ProbeBench::renderer(const FrameState& state) {
    return renderer(state, Entry::picture, glsl::Precision::single);
}

Result<render::Renderer*> ProbeBench::drawn(const FrameState& state, Entry entry, glsl::Precision precision) {
    auto made = renderer(state, entry, precision);
    if (made)
        render::FrameStepper(**made, states_of(state, precision), start_of(state)).draw(state.frame);
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

Result<std::vector<PassPicture>> ProbeBench::passes(const FrameState& state,
                                                    std::vector<PassPicture>& before) {
    auto made = TRY(renderer(state, Entry::picture, glsl::Precision::single));
    render::FrameStepper stepper(*made, states_of(state, glsl::Precision::single), start_of(state));
    stepper.lead_to(state.frame);
    if (made->plan().feedback)
        before = read_back(*made);
    stepper.draw(state.frame);
    return read_back(*made);
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

std::string ProbeBench::try_main_hit() {
    auto made = renderer(plain_state(), Entry::main_hit, glsl::Precision::single);
    if (made)
        return {};
    if (!made.error().diagnostics.empty()) { // keep only the first, which names the cause
        made.error().message.clear();
        made.error().diagnostics.resize(1);
    }
    return to_string(made.error());
}

std::string ProbeBench::try_recording() {
    const auto& function = image_function();
    if (!function)
        return "the text cannot be analysed: " + function.error().message;
    const auto recording = record_hits(scene_, *function);
    if (!recording)
        return recording.error().message;
    sees_below_ = recording->sees_below;
    fixed_steps_ = recording->fixed_steps;
    const auto plain = renderer(plain_state(), Entry::picture, glsl::Precision::single);
    const auto recorder = renderer(plain_state(), Entry::recording, glsl::Precision::single);
    if (!plain || !recorder)
        return "the instrumented text does not compile";
    return refusal_of(check_recording(**plain, **recorder, *function, plain_state()));
}

const std::string& ProbeBench::recording_problem() {
    if (!recording_problem_)
        recording_problem_ = try_recording();
    return *recording_problem_;
}

bool ProbeBench::has_hits() {
    if (std::exchange(hits_tried_, true))
        return hit_problem_.empty();
    if (has_main_hit_)
        main_hit_problem_ = try_main_hit();
    has_main_hit_ = has_main_hit_ && main_hit_problem_.empty();
    if (!has_main_hit_)
        hit_problem_ = recording_problem();
    return hit_problem_.empty();
}

const Result<PassFunction>& ProbeBench::function_of(size_t pass) {
    const auto found = functions_.find(pass);
    return found != functions_.end()
               ? found->second
               : functions_.emplace(pass, PassFunction::create(scene_, scene_.passes[pass])).first->second;
}

std::string ProbeBench::see_bounds() const {
    if (explored_)
        for (const Outside& outside : explored_->outside)
            if (outside.bound)
                return "; see bounds: " + outside.sentence;
    return {};
}

Result<Hits> ProbeBench::hits(const FrameState& state, glsl::Precision precision) {
    if (!has_main_hit_)
        return hits_of(TRY(recorded(state, glsl::RecordAnswer::hit, precision)));
    auto renderer = TRY(drawn(state, Entry::main_hit, precision));
    return hits_of((renderer)->read_back());
}

Result<image::Image> ProbeBench::recorded(const FrameState& state, glsl::RecordAnswer answer,
                                          glsl::Precision precision) {
    auto made = TRY(renderer(state, Entry::recording, precision));
    lab::ask(*made, answer);
    render::FrameStepper(*made, states_of(state, precision), start_of(state)).draw(state.frame);
    return (made)->read_back();
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
