#include "lab/specimen.hpp"

#include "base/error.hpp"
#include "base/tokens.hpp"
#include "lab/scene_numbers.hpp"
#include "lab/study.hpp"
#include "render/gl_sync.hpp"
#include "shader/definitions.hpp"
#include "shader/loops.hpp"
#include "shader/survey.hpp"

#include <GL/glcorearb.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>

namespace tidemark::lab {
namespace {

/// Prefix of the uniforms that replace numbers.
constexpr std::string_view k_setting_prefix = "tidemark_setting_";

/// Returns nullopt unless the text is a single GLSL number token: a sign is a second token.
std::optional<scene::Knob> knob_of(std::string name, const std::string& text) {
    const auto number = number_of(text);
    if (!number || text.starts_with('-'))
        return std::nullopt;
    scene::Knob knob{.name = std::move(name),
                     .type = is_int(text) ? scene::KnobType::int1 : scene::KnobType::float1};
    knob.initial[0] = knob.value[0] = *number;
    return knob;
}

} // namespace

Result<TurnableScene> TurnableScene::create(scene::Scene scene, const std::vector<Setting>& settings) {
    TurnableScene turnable(std::move(scene));
    std::vector<Setting> others;
    for (const Setting& setting : merged(settings)) {
        auto knob = knob_of(fmt::format("{}{}", k_setting_prefix, turnable.uniforms_.size()), setting.value);
        if (knob && !is_knob(turnable.original_, setting.name))
            turnable.uniforms_.push_back({setting.name, *std::move(knob)});
        else
            others.push_back(setting);
    }
    turnable.scene_ = TRY(with(turnable.original_, others));
    TRY(turnable.put_uniforms());
    return turnable;
}

Result<void> TurnableScene::put_uniforms() {
    std::vector<Setting> names;
    for (const Uniform& uniform : uniforms_) {
        const Setting place{uniform.setting, uniform.knob.name};
        if (glsl::definition_of(scene_, uniform.setting))
            names.push_back(place);
        else
            TRY(apply(scene_, place));
    }
    glsl::define_by_variables(scene_, names);
    words_ = compiled_words(scene_);
    for (const Uniform& uniform : uniforms_)
        scene_.knobs.push_back(uniform.knob);
    return {};
}

std::optional<std::vector<scene::Knob>> TurnableScene::knobs_at(const std::vector<Setting>& settings) const {
    std::vector<Setting> turned;
    std::map<std::string, std::string> texts; // of the uniforms
    for (const Setting& setting : merged(settings)) {
        const auto uniform = std::ranges::find(uniforms_, setting.name, &Uniform::setting);
        if (uniform != uniforms_.end()) {
            const auto knob = knob_of(uniform->knob.name, setting.value);
            if (!knob || knob->type != uniform->knob.type)
                return std::nullopt;
            texts[knob->name] = setting.value;
            turned.push_back({knob->name, setting.value});
        } else if (is_knob(original_, setting.name)) {
            turned.push_back(setting);
        }
    }
    const auto plain = with(original_, settings), uniform = with(scene_, turned);
    if (!plain || !uniform || !is_program_of(*plain, texts))
        return std::nullopt;
    return uniform->knobs;
}

/// Compares the tokens, except for the uniforms and the `const` that they cannot have.
bool TurnableScene::is_program_of(const scene::Scene& plain,
                                  const std::map<std::string, std::string>& texts) const {
    auto wanted = compiled_words(plain), ours = words_;
    if (!wanted || !ours)
        return false;
    for (std::string& word : *ours)
        if (const auto text = texts.find(word); text != texts.end())
            word = text->second;
    std::erase(*ours, "const");
    std::erase(*wanted, "const");
    return ours == wanted;
}

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

namespace {

/// Returns the most iterations that the loops' heads allow a pixel of any pass; infinity if that is unknown.
double most_iterations_of(const scene::Scene& set, const render::Renderer& like) {
    double most = 0;
    for (const render::PlannedPass& planned : like.plan().passes) {
        const auto text = read_text(set, set.passes[planned.pass], like.dialect(planned.pass), false);
        if (!text)
            return std::numeric_limits<double>::infinity();
        most = std::max(most, glsl::most_iterations(**text, glsl::find_facts(**text)));
    }
    return most;
}

} // namespace

Result<std::vector<LoopEnd>> Specimen::loop_ends(const View& view) {
    const render::FrameState state = state_of(view, extent_);
    std::vector<LoopEnd> all;
    for (const render::PlannedPass& planned : renderer_->plan().passes) {
        const auto preview = render::FrameStepper(*renderer_, state).preview(state.frame, planned.pass);
        auto ends = TRY(lab::loop_ends(preview, false));
        std::ranges::move(ends, std::back_inserter(all));
    }
    return all;
}

Result<std::vector<SourceLocation>> Specimen::cut_loops(const scene::Scene& set,
                                                        const std::vector<View>& views) {
    std::vector<SourceLocation> cut;
    const double most = most_iterations_of(set, *renderer_);
    // Loops of unknown length are looked at in one view, and only by the program that serves all settings.
    const bool known = std::isfinite(most);
    const bool serves_all = std::ranges::any_of(renderer_->scene().knobs, [](const scene::Knob& knob) {
        return knob.name.starts_with(k_setting_prefix);
    });
    if (most <= k_safe_iterations || (!known && !serves_all) || !TRY(loop_limit()))
        return cut;
    for (const View& view : views) {
        for (const LoopEnd& end : TRY(loop_ends(view)))
            if (end.cut && std::ranges::find(cut, end.where) == cut.end())
                cut.push_back(end.where);
        if (!known)
            break;
    }
    return cut;
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

Result<Specimen*> TurnedSpecimen::at(const std::vector<Setting>& settings, glsl::Precision precision) {
    if (precision != precision_)
        turnable_.reset();
    precision_ = precision;
    const std::string name = to_string(settings);
    if (turnable_ && !known_.contains(name))
        if (const auto knobs = turnable_->knobs_at(settings))
            known_[name] = *knobs;
    if (const auto knobs = known_.find(name); turnable_ && knobs != known_.end()) {
        specimen_->turn(knobs->second);
        return &*specimen_;
    }
    if (own_text_only_ || !make_turnable(settings)) {
        turnable_.reset();
        specimen_ = TRY(Specimen::create(scene_, {settings, precision_}, extent_, hits_));
        own_text_only_ = true;
    }
    return &*specimen_;
}

bool TurnedSpecimen::make_turnable(const std::vector<Setting>& settings) {
    auto turnable = TurnableScene::create(scene_, settings);
    if (!turnable || !turnable->knobs_at(settings))
        return false;
    auto specimen = Specimen::create(turnable->scene(), {{}, precision_}, extent_, hits_);
    if (!specimen)
        return false;
    turnable_ = *std::move(turnable);
    specimen_ = *std::move(specimen);
    known_.clear();
    return true;
}

namespace {

/// How the effect of a buffer's rounding is tried: relative changes of its values, pseudo-random in sign, and
/// the share of the picture's change that stands for rounding alone. From a double, 2^-25 moves a stored
/// float to its neighbour so often that the change is 1.7 to 2.4 times that of rounding; floats themselves
/// must be moved by a whole step.
struct Nudge {
    const char* relative;
    double share;
};
constexpr Nudge k_double_nudge{"2.98023224e-8", 0.6}, k_float_nudge{"6.0e-8", 0.35};

/// Appended to a pass whose own mainImage has another name.
constexpr std::string_view k_nudged_pass = R"(
void mainImage(out vec4 tidemark_c, in vec2 tidemark_p) {{
    {}(tidemark_c, tidemark_p);
    int tidemark_k = int(tidemark_p.x) * 1973 + int(tidemark_p.y) * 9277 + iFrame * 26699;
    tidemark_k = (tidemark_k * 7919) & 65535;
    vec4 tidemark_s = vec4(float((tidemark_k / 16) % 2), float((tidemark_k / 32) % 2),
                           float((tidemark_k / 64) % 2), float((tidemark_k / 128) % 2));
    tidemark_c *= 1.0 + {} * (2.0 * tidemark_s - 1.0);
}}
)";

} // namespace

std::optional<scene::Scene> with_nudged_buffers(scene::Scene scene, glsl::Precision precision,
                                                double& share) {
    const Nudge& nudge = precision == glsl::Precision::single ? k_float_nudge : k_double_nudge;
    share = nudge.share;
    constexpr const char* k_own = "tidemark_exact_image";
    for (scene::Pass& pass : scene.passes) {
        if (pass.kind != scene::PassKind::buffer)
            continue;
        std::vector<text::Edit> edits;
        for (const text::Token& token : text::tokenize(pass.text.text()))
            if (token.is("mainImage"))
                edits.push_back({token.begin, token.end(), k_own});
        if (edits.empty())
            return std::nullopt;
        pass.text.apply(edits);
        pass.text.append(fmt::format(k_nudged_pass, k_own, nudge.relative), "rounding.glsl", 1);
    }
    return scene;
}

} // namespace tidemark::lab
