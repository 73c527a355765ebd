#include "lab/march_hits.hpp"

#include "base/error.hpp"
#include "base/measurement.hpp"
#include "proof/ray_proofs.hpp"
#include "render/frame_stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <thread>

namespace tidemark::lab {
namespace {

using RayOutcome = ProvedRay::Outcome;
using FirstVerdict = proof::FirstHit::Verdict;

/// Mipmap levels differ by more than the usual width of a hit; this is still narrower than is visible.
constexpr double k_width_at_any_level = 1e-3;
/// Each evaluation covers all levels; most decided rays need about fifty.
constexpr uint64_t k_most_at_any_level = 500;
/// Below the threshold by more than rounding.
constexpr float k_surely_below = -1e-5f;

/// Returns whether a sample of the march was below the threshold where that is excluded. A march that goes
/// backwards may sample places before its start. For a threshold that changes with the iterations zero is
/// used instead, because the first threshold is not below it.
bool contradicts(const proof::MarchSlice& slice, const proof::March& march, const proof::FirstHit& found,
                 bool threshold_by_turn) {
    const double free_to = found.verdict == FirstVerdict::none ? found.where.high : found.where.low;
    return std::ranges::any_of(march.turns, [&](const proof::Turn& turn) {
        const double at = slice.parameter(turn);
        return (threshold_by_turn ? turn.measured : turn.distance()) < k_surely_below &&
               at >= slice.start() && at < free_to - 1e-6 * std::max(1.0, std::abs(free_to));
    });
}

/// Returns the furthest place before the last one. Single steps may have been taken back.
double place_before_last(const proof::MarchSlice& slice, const proof::March& march) {
    const double last = slice.parameter(march.turns.back());
    double before = slice.start();
    for (const proof::Turn& turn : march.turns)
        if (const double at = slice.parameter(turn); at < last)
            before = std::max(before, at);
    return before;
}

/// Returns how far the march has passed along the ray. A march that looks for a change of sign ends below the
/// surface and goes back after the loop, so the sample before that counts.
double passed_by(const proof::MarchSlice& slice, const proof::MarchingLoop& loop, const proof::March& march) {
    const bool to_sign = march.turns.back().threshold == 0 || (!loop.stops_before && loop.goes_back);
    return march.hit && to_sign ? place_before_last(slice, march) : slice.parameter(march.turns.back());
}

/// Returns whether the interval is as narrow as the tolerance by which a march is judged.
bool is_narrow(const proof::FirstHit& found) {
    return found.verdict == FirstVerdict::none ||
           (found.verdict == FirstVerdict::hit &&
            found.where.width() <= k_same_end * std::max(1.0, std::abs(found.where.high)));
}

double tolerance(double place) {
    return k_same_end * std::max(1.0, std::abs(place));
}

/// Sets the ray's outcome.
void judge(ProvedRay& ray, const proof::MarchSlice& slice, const proof::MarchingLoop& loop,
           const proof::March& march, const proof::FirstHit& found) {
    const double last = slice.parameter(march.turns.back());
    ray.outcome = RayOutcome::agrees;
    if (found.verdict == FirstVerdict::undecided)
        ray.outcome = RayOutcome::undecided;
    else if (found.verdict == FirstVerdict::none)
        return;
    else if (!march.hit) {
        // A march may run out at the surface, and its text then takes that place for the hit.
        const bool at_limit = march.far && (!loop.turns || march.turns.size() < *loop.turns);
        ray.went_past = at_limit || last > found.where.high + tolerance(last);
        if (ray.went_past || last < found.where.low - tolerance(last))
            ray.outcome = RayOutcome::misses;
    } else if (const double ended = passed_by(slice, loop, march);
               ended > found.where.high + tolerance(ended)) {
        ray.outcome = RayOutcome::steps_over;
        const double before = place_before_last(slice, march);
        ray.within_last_step = before <= found.where.high + tolerance(before);
    }
}

} // namespace

std::optional<ProvedRay> prove_ray(const PassFunction& function, const proof::FloatEvaluator& pixel,
                                   const proof::TextureSet& textures, glm::ivec2 at,
                                   uint64_t most_evaluations) {
    proof::FloatEvaluator evaluator = pixel;
    bool unknown = false, chooses_level = false;
    evaluator.textures = [&](const proof::Lookup& lookup, std::span<const proof::Point<float>> operands) {
        const auto texels = textures.find(lookup.sampler);
        unknown = unknown || texels == textures.end();
        chooses_level = chooses_level || (!unknown && texels->second->chooses_level(lookup));
        return proof::look_up(textures, lookup, operands);
    };
    const auto loop_index = proof::enter_first(evaluator, function.loops());
    if (!loop_index)
        return std::nullopt;
    ProvedRay ray{at, *loop_index};
    const proof::LoopSlice& loop_slice = function.slices()[*loop_index];
    const proof::FloatEvaluator entered = evaluator;
    unknown = chooses_level = false; // from here on only reads of the march count
    const proof::March march = proof::follow(evaluator, function.function(), loop_slice.loop);
    ray.turns = march.turns.size();
    if (unknown) {
        ray.outcome = RayOutcome::unknown_texture;
        return ray;
    }
    if (march.turns.empty()) { // its range is empty
        ray.outcome = RayOutcome::agrees;
        return ray;
    }
    if (!proof::is_faithful(loop_slice, entered, march)) {
        ray.outcome = RayOutcome::unfaithful;
        return ray;
    }
    proof::MarchSlice slice(loop_slice, entered, proof::textures_in<proof::Interval>(textures));
    const double end = slice.end(march);
    if (end < slice.start()) {
        ray.reason = proof::FirstHit::Reason::not_finite;
        return ray;
    }
    proof::FirstHit found;
    if (chooses_level) {
        proof::MarchSlice at_any(loop_slice, entered, proof::textures_at_any_level(textures));
        found = proof::first_hit(at_any, end, k_most_at_any_level, k_width_at_any_level);
    }
    ray.at_base_level = chooses_level && !is_narrow(found);
    if (!chooses_level || ray.at_base_level)
        found = proof::first_hit(slice, end, most_evaluations);
    judge(ray, slice, loop_slice.loop, march, found);
    ray.reason = found.reason;
    ray.evaluations = found.evaluations;
    ray.contradicted = contradicts(slice, march, found, loop_slice.loop.threshold_by_turn);
    return ray;
}

void RayCounts::add(const ProvedRay& ray) {
    ++rays;
    contradicted += ray.contradicted;
    at_base_level += ray.at_base_level;
    within_last_step += ray.within_last_step;
    went_past += ray.went_past;
    if (ray.evaluations > 0)
        evaluations.push_back(double(ray.evaluations));
    if (!wrong_loop && (ray.outcome == RayOutcome::steps_over || ray.outcome == RayOutcome::misses))
        wrong_loop = ray.loop;
    switch (ray.outcome) {
    case RayOutcome::agrees: ++agree; break;
    case RayOutcome::steps_over: ++step_over; break;
    case RayOutcome::misses: ++miss; break;
    case RayOutcome::undecided:
        ++undecided;
        ++reasons[size_t(ray.reason)];
        break;
    case RayOutcome::unknown_texture: ++unknown_texture; break;
    case RayOutcome::unfaithful: ++unfaithful; break;
    }
}

proof::FirstHit::Reason RayCounts::commonest() const {
    return proof::FirstHit::Reason(std::ranges::max_element(reasons) - reasons.begin());
}

namespace {

constexpr double k_relative_width = 1e-9;
constexpr uint64_t k_most_evaluations = 20'000;
/// Number of rays from which the time per ray is estimated.
constexpr size_t k_pilot = 64;

constexpr proof::Interval k_no_hit{-1, -1};

/// Returns the interval of the first hit; k_no_hit if there is none; nullopt if it is not known.
std::optional<proof::Interval> hit_of(const MarchRays& rays, size_t number, proof::Surface surface) {
    const int width = rays.extent().width;
    auto ray = rays.enter({int(number) % width, int(number) / width}, surface);
    if (!ray || (ray->slice && ray->march.turns.empty()))
        return k_no_hit;
    if (!ray->slice)
        return std::nullopt;
    proof::MarchSlice& slice = *ray->slice;
    const bool limited = ray->march.far.has_value();
    const double last = slice.end(ray->march);
    if (last < slice.start())
        return limited ? std::optional(k_no_hit) : std::nullopt;
    const proof::FirstHit found = proof::first_hit(slice, last, k_most_evaluations, k_relative_width);
    if (found.verdict == proof::FirstHit::Verdict::hit)
        return proof::Interval{found.where.low * slice.unit(), found.where.high * slice.unit()};
    const bool none = found.verdict == proof::FirstHit::Verdict::none && limited;
    return none ? std::optional(k_no_hit) : std::nullopt;
}

using Found = std::vector<std::optional<proof::Interval>>;

/// The first few rays, and the seconds that one takes.
struct Pilot {
    proof::Surface surface;
    Found found{};
    double seconds = 0;

    Pilot(const MarchRays& rays, proof::Surface which) : surface(which) {
        const size_t pixels = rays.extent().pixels();
        const auto start = std::chrono::steady_clock::now();
        while (found.size() < std::min(k_pilot, pixels))
            found.push_back(hit_of(rays, spread(found.size(), pixels), surface));
        const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
        seconds = all.count() / double(found.size());
    }

    size_t hits() const {
        return size_t(
            std::ranges::count_if(found, [](const auto& each) { return each && each->low != k_no_hit.low; }));
    }
};

/// Searches for zeros, unless fewer than half of the rays that fall below the threshold have one.
Pilot pilot_of(const MarchRays& rays) {
    Pilot zeros(rays, proof::Surface::zero), places(rays, proof::Surface::threshold);
    return 2 * zeros.hits() < places.hits() ? places : zeros;
}

TrueHits hit_truth_of(const Found& found, size_t pixels, proof::Surface surface) {
    TrueHits truth;
    truth.surface = surface;
    truth.looked_at = found.size();
    truth.hits.distance.assign(pixels, std::nan(""));
    truth.hits.evaluations.assign(pixels, 0.0f);
    truth.hits.flags.assign(pixels, 0);
    double squares = 0;
    for (size_t i = 0; i < found.size(); ++i) {
        if (!found[i]) {
            ++truth.unknown;
            continue;
        }
        truth.hits.distance[spread(i, pixels)] = found[i]->low + found[i]->width() / 2;
        squares += found[i]->width() * found[i]->width() / 4;
    }
    truth.half_width = std::sqrt(squares / double(std::max<size_t>(1, truth.looked_at - truth.unknown)));
    return truth;
}

} // namespace

std::optional<TrueHits> true_hits(const DrawnPass& drawn, double seconds, const KeepGoing& keep_going) {
    const MarchRays rays(drawn);
    const size_t pixels = rays.extent().pixels();
    Pilot pilot = pilot_of(rays);
    Found& found = pilot.found;
    const double affordable = seconds * std::max(1u, std::thread::hardware_concurrency()) / pilot.seconds;
    const auto every = size_t(std::ceil(std::max(1.0, double(pixels) / affordable)));
    const size_t first = found.size();
    found.resize(std::max(first, pixels / every));
    const bool complete = on_all_cores(found.size() - first, keep_going, [&](size_t i) {
        found[first + i] = hit_of(rays, spread(first + i, pixels), pilot.surface);
    });
    return complete ? std::optional(hit_truth_of(found, pixels, pilot.surface)) : std::nullopt;
}

namespace {

/// Approximate number of pixels that are compared with the CPU.
constexpr double k_compared = 900;
/// A march with an iteration more or less ends within its threshold of the same place.
constexpr float k_same_place = 2e-3f;
constexpr float k_same_turns = 0.05f;
constexpr double k_least_agreeing = 0.9;

/// Returns the index of the carried value that is the ray's parameter itself.
std::optional<size_t> parameter_of(const proof::MarchingLoop& loop) {
    for (size_t i = 0; i < loop.carried.size(); ++i)
        if (loop.by_parameter() || loop.carried[i].factors.empty())
            return i;
    return std::nullopt;
}

/// Copies Common into each pass, so that Image's copy can be changed.
void inline_common(scene::Scene& scene) {
    for (scene::Pass& pass : scene.passes) {
        text::MappedText whole = scene.common;
        whole.append(pass.text);
        pass.text = std::move(whole);
    }
    scene.common = {};
}

image::Image answer(render::Renderer& renderer, glsl::RecordAnswer which, const render::FrameState& state) {
    ask(renderer, which);
    render::FrameStepper(renderer, state).draw(state.frame);
    return renderer.read_back();
}

/// Lets NaN equal itself in comparisons.
uint32_t as_bits(float value) {
    return std::bit_cast<uint32_t>(value);
}

/// A compiler may round the instrumented text differently; no screen shows a difference below this one.
constexpr float k_same_colour = 0x1p-12f;

size_t differing_colours(const image::Image& a, const image::Image& b) {
    const auto same = [](float left, float right) {
        return as_bits(left) == as_bits(right) ||
               std::abs(left - right) <= k_same_colour * std::max(1.0f, std::abs(left));
    };
    size_t count = 0;
    for (size_t i = 0; i < a.extent.pixels(); ++i)
        count += !std::ranges::equal(a.f32().subspan(4 * i, 3), b.f32().subspan(4 * i, 3), same);
    return count;
}

/// The march of a pixel on the CPU.
struct CpuMarch {
    bool textured = false;
    proof::March march;
    float place = 0; ///< place on the ray of the last distance measured
};

float place_of(const proof::MarchingLoop& loop, const proof::FloatEvaluator& entered,
               const proof::Turn& turn) {
    if (const auto parameter = parameter_of(loop))
        return turn.carried[*parameter];
    float squares = 0;
    for (size_t i = 0; i < turn.carried.size(); ++i) {
        const float way = turn.carried[i] - entered.value(loop.carried[i].phi).real;
        squares += way * way;
    }
    return std::sqrt(squares);
}

/// Runs the pixel that `evaluator` is set to; nullopt if it enters no marching loop.
std::optional<CpuMarch> march_of(const PassFunction& image, proof::FloatEvaluator& evaluator) {
    CpuMarch result;
    evaluator.textures = [&](const proof::Lookup&, std::span<const proof::Point<float>>) {
        result.textured = true;
        return proof::Point<float>{};
    };
    const auto entered = proof::enter_first(evaluator, image.loops());
    if (!entered)
        return std::nullopt;
    const proof::MarchingLoop& loop = image.loops()[*entered];
    const proof::FloatEvaluator at_entry = evaluator;
    result.march = proof::follow(evaluator, image.function(), loop);
    if (!result.march.turns.empty())
        result.place = place_of(loop, at_entry, result.march.turns.back());
    return result;
}

bool same_place(float a, float b) {
    return (std::isnan(a) && std::isnan(b)) ||
           std::abs(a - b) <= k_same_place * std::max({1.0f, std::abs(a), std::abs(b)});
}

/// The end of a march that goes astray far away depends on rounding, so only the places of hits are compared.
bool agrees(const CpuMarch& cpu, const float* recorded) {
    const auto turns = float(cpu.march.turns.size());
    if (turns == 0 || recorded[1] == 0)
        return turns == recorded[1];
    const bool hit = recorded[2] <= recorded[3];
    return hit == cpu.march.hit && std::abs(recorded[1] - turns) <= std::max(1.0f, k_same_turns * turns) &&
           (!hit || same_place(recorded[0], cpu.place));
}

} // namespace

glsl::MarchLines lines_of(const PassFunction& image, const proof::MarchingLoop& loop) {
    const proof::Function& function = image.function();
    const proof::Instruction& comparison = function.instructions[loop.comparison];
    glsl::MarchLines lines;
    lines.test = image.locate(loop.line);
    lines.comparisons = loop.comparisons;
    lines.which = loop.which;
    lines.distance_is_less = function.operands_of(comparison)[0] == loop.distance;
    const auto parameter = parameter_of(loop);
    for (size_t i = 0; i < loop.carried.size(); ++i)
        if (!parameter || i == *parameter)
            lines.updates.push_back(image.locate(function.instructions[loop.carried[i].update].line));
    lines.at_update = loop.cut_at_update;
    lines.fixed_steps = loop.kind == proof::MarchingLoop::Kind::fixed_step;
    lines.in_next_turn = loop.in_next_turn;
    lines.stops_before = loop.stops_before;
    return lines;
}

std::vector<glsl::MarchLines> marches_of(const PassFunction& image) {
    std::vector<glsl::MarchLines> marches;
    for (const proof::MarchingLoop& loop : image.loops())
        if (glsl::MarchLines lines = lines_of(image, loop);
            std::ranges::find(marches, lines) == marches.end())
            marches.push_back(std::move(lines));
    return marches;
}

scene::Scene with_pass_copy(const scene::Scene& scene, size_t pass) {
    scene::Scene copied = scene;
    copied.passes.insert(copied.passes.begin() + long(pass), scene.passes[pass]);
    copied.passes[pass].name = k_copied_pass;
    for (scene::Pass& each : copied.passes)
        for (scene::Channel& channel : each.channels)
            if (size_t* const read = scene::source_pass(channel.input); read && *read >= pass)
                ++*read;
    return copied;
}

std::string_view rewritten_pass(const scene::Scene& scene, size_t pass) {
    return pass == scene.image_index() ? std::string_view() : k_copied_pass;
}

Result<scene::Scene> with_hit_text(const scene::Scene& scene, size_t pass, const RewriteText& rewrite) {
    const bool buffer = pass != scene.image_index();
    scene::Scene rewritten = buffer ? with_pass_copy(scene, pass) : scene;
    inline_common(rewritten);
    scene::Pass& instrumented = rewritten.passes[pass];
    const auto text = TRY(glsl::ParsedText::read(instrumented.text, glsl::k_site_macros));
    instrumented.text = TRY(rewrite(*text, glsl::find_facts(*text)));
    instrumented.kind = scene::PassKind::hit;
    if (buffer && !instrumented.stores_bytes)
        instrumented.definitions += "#define TIDEMARK_ALL_BITS\n";
    instrumented.stores_bytes = false;
    return rewritten;
}

Result<Recording> record_hits(const scene::Scene& scene, const PassFunction& image) {
    if (image.loops().empty())
        return fail(ErrorCode::load, "no ray-marching loop found in Image");
    const std::vector<glsl::MarchLines> marches = marches_of(image);
    Recording recording{scene, std::ranges::all_of(marches, &glsl::MarchLines::stops_before),
                        std::ranges::all_of(marches, &glsl::MarchLines::fixed_steps)};
    recording.scene = TRY(with_hit_text(scene, scene.image_index(), [&](const auto& text, const auto& facts) {
        return glsl::record_marches(text, facts, marches);
    }));
    recording.scene.knobs.push_back({.name = std::string(glsl::k_record_knob)});
    return recording;
}

void ask(render::Renderer& recording, glsl::RecordAnswer answer) {
    std::vector<scene::Knob> knobs = recording.scene().knobs;
    knobs.back().value = {double(answer)};
    recording.turn(std::move(knobs));
}

RecordingCheck check_recording(render::Renderer& plain, render::Renderer& recording,
                               const PassFunction& image, const render::FrameState& state) {
    RecordingCheck check;
    render::FrameStepper(plain, state).draw(state.frame);
    check.other_pixels =
        differing_colours(plain.read_back(), answer(recording, glsl::RecordAnswer::picture, state));
    const image::Image marches = answer(recording, glsl::RecordAnswer::march, state);
    answer(recording, glsl::RecordAnswer::hit, state);
    const proof::FloatEvaluator frame = image.frame(plain, plain.scene().image_index(), inputs_of(state));
    const Extent extent = plain.extent();
    const int stride = std::max(1, int(std::sqrt(double(extent.pixels()) / k_compared)));
    for (int y = stride / 2; y < extent.height; y += stride)
        for (int x = stride / 2; x < extent.width; x += stride) {
            proof::FloatEvaluator pixel = frame;
            image.move_to(pixel, {x, y});
            const auto cpu = march_of(image, pixel);
            if (!cpu)
                continue;
            ++check.rays;
            check.textured += cpu->textured;
            check.agree += !cpu->textured && agrees(*cpu, &marches.f32()[4 * size_t(y * extent.width + x)]);
        }
    return check;
}

std::string refusal_of(const RecordingCheck& check) {
    if (check.other_pixels > 0)
        return fmt::format("the instrumented text changes {} pixels", check.other_pixels);
    if (check.rays == 0)
        return "no ray reaches the marching loop";
    if (double(check.agree) < k_least_agreeing * double(check.compared()))
        return fmt::format("of {} recorded rays only {} agree with those computed from the text",
                           check.compared(), check.agree);
    return {};
}

} // namespace tidemark::lab
