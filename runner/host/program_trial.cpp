#include "host/program_trial.hpp"

#include "base/error.hpp"
#include "base/measurement.hpp"
#include "host/scene_report.hpp"
#include "render/gl_context.hpp"

#include <GL/glcorearb.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>
#include <vector>

namespace tidemark::host {
namespace {

using render::Renderer;

/// The cost of a trial relative to the cost of the sequence, at most.
constexpr double k_share_of_sequence = 1.0 / 20;
/// Approximate number of frames that such a trial draws, not counting the start.
constexpr double k_frames_of_trial = 3;
/// In a window, a gain of less than 3 % is within the clock's accuracy and not worth a change.
constexpr double k_largest_share = 0.97;
/// The longest timing in a window, whose own drawing slows both programs down meanwhile.
constexpr double k_longest_timing_ms = 10'000;

/// With a software renderer, outside a window, the process's CPU time is the measure: other processes do not
/// affect it.
using ElapsedClock = double lab::Elapsed::*;
ElapsedClock clock_of(const TrialPlan& plan) {
    const bool in_software = gl::is_software_renderer(gl::query_capabilities().renderer);
    return in_software && !plan.in_window ? &lab::Elapsed::cpu : &lab::Elapsed::wall;
}

/// Waits for all drawing; returns the elapsed milliseconds.
double milliseconds_on(const lab::Stopwatch& watch, ElapsedClock clock) {
    glFinish();
    return watch.elapsed().*clock;
}

/// Times one frame from a reset state: a frame drawn just before would cost nothing to draw again.
double milliseconds_of(Renderer& renderer, const render::FrameInputs& inputs, ElapsedClock clock) {
    renderer.reset();
    glFinish();
    const lab::Stopwatch watch;
    renderer.draw(inputs);
    return milliseconds_on(watch, clock);
}

/// Times a frame, then leaves the device idle for as long: a software driver draws for one context at a time,
/// and a context that returns at once is served first.
double politely_timed(Renderer& renderer, const render::FrameInputs& inputs) {
    const double milliseconds = milliseconds_of(renderer, inputs, &lab::Elapsed::wall);
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(milliseconds));
    return milliseconds;
}

/// Returns the time of `renderer` relative to `other`, drawing alternately, so that other load affects both
/// of a pair.
std::optional<double> share_of(Renderer& renderer, Renderer& other, const TrialPlan& plan) {
    const lab::Stopwatch watch;
    const auto next_pair = [&]() -> std::optional<double> {
        if (watch.elapsed().wall > k_longest_timing_ms)
            return std::nullopt;
        const double others = politely_timed(other, plan.last);
        return politely_timed(renderer, plan.last) / others;
    };
    return clear_share(next_pair, k_largest_share);
}

/// Returns the largest difference of a sample: 0 if all bytes are equal, infinity if only one of two is NaN
/// or infinite.
double difference_of(const image::Image& a, const image::Image& b) {
    if (a.bytes == b.bytes)
        return 0;
    double largest = 0;
    for (size_t at = 0; at + sizeof(float) <= a.bytes.size(); at += sizeof(float)) {
        float one = 0;
        float other = 0;
        std::memcpy(&one, a.bytes.data() + at, sizeof one);
        std::memcpy(&other, b.bytes.data() + at, sizeof other);
        if (std::bit_cast<uint32_t>(one) == std::bit_cast<uint32_t>(other))
            continue;
        const double difference = std::abs(double(one) - double(other));
        largest = std::isnan(difference)
                      ? std::numeric_limits<double>::infinity()
                      : std::max({largest, difference, std::numeric_limits<double>::denorm_min()});
    }
    return largest;
}

using Pictures = std::vector<image::Image>;

/// Reads back all passes after a frame.
Pictures pictures_of(const Renderer& renderer) {
    Pictures pictures;
    for (const render::PlannedPass& planned : renderer.plan().passes) {
        const bool cube = renderer.scene().passes[planned.pass].kind == scene::PassKind::cubemap;
        for (int face = 0; face < (cube ? 6 : 1); ++face)
            pictures.push_back(renderer.read_floats(planned.pass, face));
    }
    return pictures;
}

double difference_of(const Pictures& a, const Pictures& b) {
    if (a.size() != b.size())
        return std::numeric_limits<double>::infinity();
    double largest = 0;
    for (size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, difference_of(a[i], b[i]));
    return largest;
}

/// Returns a trial in doubt, with zeroed buffers.
Trial blank(Renderer renderer) {
    renderer.reset();
    return {.renderer = std::move(renderer), .in_doubt = true};
}

std::string verdict(double difference, std::optional<double> allowed, bool taken) {
    if (taken && difference > 0)
        return fmt::format("specialised: differs from the plain program by at most {:.3g} in the frames "
                           "tried (allowed by --allow-difference)",
                           difference);
    if (allowed && difference > *allowed)
        return fmt::format("not specialised: it would differ from the plain program by {:.3g}", difference);
    return {};
}

} // namespace

std::optional<double> clear_share(const std::function<std::optional<double>()>& next_pair, double largest) {
    std::vector<double> shares;
    while (const auto share = next_pair()) {
        shares.push_back(*share);
        if (shares.size() < lab::k_fewest_runs)
            continue;
        const lab::Interval median = lab::bootstrap_median(shares);
        if (median.high < largest)
            return lab::median(std::move(shares));
        if (median.low > largest)
            return std::nullopt;
    }
    return std::nullopt;
}

bool worth_trying(const Renderer& renderer, glsl::Specialise how) {
    return std::ranges::any_of(renderer.plan().passes, [&](const render::PlannedPass& planned) {
        return left_out_of(renderer, planned.pass, how).in_doubt();
    });
}

Result<Trial> choose_program(const scene::Scene& scene, const render::RenderOptions& options,
                             const TrialPlan& plan) {
    render::RenderOptions certain = options;
    certain.specialise = glsl::Specialise::unreachable;
    const ElapsedClock clock = clock_of(plan);
    const lab::Stopwatch start;
    auto plain = TRY(Renderer::create(scene, certain));
    if (!worth_trying(plain, options.specialise))
        return Trial{std::move(plain)};
    plain.draw(plan.first);
    const double plain_start = milliseconds_on(start, clock);
    const Pictures first = pictures_of(plain);
    const double plain_time = milliseconds_of(plain, plan.last, clock);
    const Pictures last = pictures_of(plain);
    const double cost = plain_start + k_frames_of_trial * plain_time;
    if (!plan.allowed && cost > k_share_of_sequence * double(plan.frames) * plain_time)
        return blank(std::move(plain));
    auto special = Renderer::create(scene, options);
    if (!special)
        return blank(std::move(plain));
    special->draw(plan.first);
    double difference = difference_of(pictures_of(*special), first);
    std::optional<double> share = milliseconds_of(*special, plan.last, clock) / plain_time;
    difference = std::max(difference, difference_of(pictures_of(*special), last));
    const bool close = difference <= plan.allowed.value_or(0);
    if (close && plan.in_window)
        share = share_of(*special, plain, plan);
    const bool taken = close && share && *share < 1;
    Trial trial = blank(taken ? *std::move(special) : std::move(plain));
    trial.said = verdict(difference, plan.allowed, taken);
    if (taken)
        trial.share = share;
    return trial;
}

} // namespace tidemark::host
