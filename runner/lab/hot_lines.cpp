// Finds the lines of a text that cost most: counts the operations of each, and measures them by doing a
// line's operations twice.

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/measurement.hpp"
#include "lab/instrumented_pass.hpp"
#include "lab/lens.hpp"
#include "lab/march_hits.hpp"
#include "lab/probe_inputs.hpp"
#include "render/frame_stepper.hpp"
#include "render/gl_context.hpp"

#include <GL/glcorearb.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace tidemark::lab {
namespace {

using PlaceOfLine = std::pair<std::string, int>;

/// Returns the trimmed text of each line of Common and of the passes.
std::map<PlaceOfLine, std::string> lines_of_texts(const scene::Scene& scene) {
    std::map<PlaceOfLine, std::string> texts;
    const auto add = [&](const text::MappedText& part) {
        const std::string& all = part.text();
        for (size_t begin = 0, number = 1; begin < all.size(); ++number) {
            const size_t end = std::min(all.find('\n', begin), all.size());
            const SourceLocation where = part.lines().locate(int(number));
            texts.try_emplace({where.file, where.line},
                              trimmed(std::string_view(all).substr(begin, end - begin)));
            begin = end + 1;
        }
    };
    add(scene.common);
    for (const scene::Pass& pass : scene.passes)
        add(pass.text);
    return texts;
}

/// A scene that counts the sites of a pass; its last knob selects four of them.
struct CountingScene {
    scene::Scene scene;
    glsl::WorkText counted;
};

Result<CountingScene> counting_scene(const scene::Scene& scene, size_t pass,
                                     const glsl::WorkWeights& weights) {
    CountingScene counting;
    const RewriteText rewrite = [&](const auto& text, const auto& facts) -> Result<text::MappedText> {
        counting.counted = TRY(glsl::count_operations(text, facts, glsl::WorkAnswer::sites, weights));
        return counting.counted.text;
    };
    counting.scene = TRY(with_hit_text(scene, pass, rewrite));
    counting.scene.knobs.push_back({.name = std::string(glsl::k_sites_knob)});
    return counting;
}

/// How often each site ran, for each group of pixels that the device runs together: the largest count of a
/// pixel of the group.
using RunsOfSites = std::vector<std::vector<float>>;

/// Returns the sides of a group of so many pixels, as rasterisers form them of blocks of 2x2.
Extent group_of(int lanes) {
    Extent group{1, 1};
    for (int pixels = 1; pixels < lanes; pixels *= 2)
        (group.width > group.height ? group.height : group.width) *= 2;
    return group;
}

void add_counts(const image::Image& counts, int channel, Extent group, std::vector<float>& runs) {
    const Extent extent = counts.extent;
    const int across = (extent.width + group.width - 1) / group.width;
    runs.assign(size_t(across) * size_t((extent.height + group.height - 1) / group.height), 0);
    const auto samples = counts.f32();
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            float& most = runs[size_t(y / group.height) * size_t(across) + size_t(x / group.width)];
            most =
                std::max(most, samples[4 * (size_t(y) * size_t(extent.width) + size_t(x)) + size_t(channel)]);
        }
}

/// Counts the sites in `wanted`; the others stay empty.
Result<RunsOfSites> runs_of_sites(const CountingScene& counting, std::string_view pass,
                                  const std::vector<bool>& wanted, const render::FrameState& state,
                                  Extent group) {
    auto renderer =
        TRY(render::Renderer::create(counting.scene, {.extent = state.extent,
                                                      .samples = image::SampleType::f32,
                                                      .pass = std::string(pass),
                                                      .specialise = glsl::Specialise::unreachable}));
    const PassPreview preview = render::FrameStepper(renderer, state, first_frame_of(state))
                                    .preview(state.frame, renderer.shown_index());
    RunsOfSites runs(wanted.size());
    for (size_t first = 0; first < wanted.size(); first += 4) {
        const size_t end = std::min(first + 4, wanted.size());
        if (std::none_of(wanted.begin() + long(first), wanted.begin() + long(end), std::identity()))
            continue;
        std::vector<scene::Knob> knobs = renderer.scene().knobs;
        knobs.back().value = {double(first / 4)};
        renderer.turn(std::move(knobs));
        const image::Image counts = TRY(draw_own(preview, state.extent));
        for (size_t site = first; site < end; ++site)
            if (wanted[site])
                add_counts(counts, int(site - first), group, runs[site]);
    }
    return runs;
}

/// Returns how often a device that runs both sides of branches runs each block, all groups together: the body
/// of a loop until all pixels of the group are done, but at least once each time it gets there; the body of a
/// function at each of its calls.
class BlockRuns {
public:
    BlockRuns(const glsl::WorkText& counted, const RunsOfSites& runs, size_t groups)
        : counted_(counted), runs_(runs), groups_(groups), known_(counted.blocks.size()) {}

    /// Returns one number for each group.
    const std::vector<double>& of(size_t block) {
        std::optional<std::vector<double>>& known = known_[block];
        if (known)
            return *known;
        known.emplace(groups_); // zeros, also if functions call each other in a circle
        const glsl::WorkBlock& wanted = counted_.blocks[block];
        std::vector<double> all(groups_, wanted.function == counted_.main_image ? 1.0 : 0.0);
        if (wanted.around) {
            const std::vector<double>& around = of(*wanted.around);
            for (size_t i = 0; i < groups_; ++i)
                all[i] = std::max(around[i], double(runs_[wanted.site][i]));
        } else {
            for (const glsl::WorkSite& site : counted_.sites)
                for (const glsl::NodeId called : site.calls)
                    if (called == wanted.function) {
                        const std::vector<double>& from = of(site.block);
                        for (size_t i = 0; i < groups_; ++i)
                            all[i] += from[i];
                    }
        }
        known_[block] = std::move(all);
        return *known_[block];
    }

private:
    const glsl::WorkText& counted_;
    const RunsOfSites& runs_;
    size_t groups_;
    std::vector<std::optional<std::vector<double>>> known_;
};

/// Draws the cost lens of the pass, which fails if the instrumented text draws another picture than `plain`.
Result<void> check_counts(render::Renderer& plain, size_t pass, const render::FrameState& state) {
    const scene::Scene& scene = plain.scene();
    const LensPlan plan = TRY(make_lens(scene, {.name = LensName::cost, .pass = scene.passes[pass].name}));
    auto drawn = TRY(render::Renderer::create(*plan.drawn, lens_options(plan, state.extent)));
    render::FrameStepper(drawn, state, first_frame_of(state)).draw(state.frame);
    TRY(read_lens(plan, {plain, &drawn, inputs_of(state)}, [] { return true; }));
    return {};
}

using WorkOfLines = std::map<PlaceOfLine, double>;

/// Adds the work of all pixels of a pass, by line. `plain` has drawn the frame.
Result<void> add_work(render::Renderer& plain, size_t pass, const render::FrameState& state,
                      const glsl::WorkWeights& weights, WorkOfLines& work) {
    const scene::Scene& scene = plain.scene();
    if (scene.passes[pass].kind == scene::PassKind::cubemap)
        return fail(ErrorCode::load, "the faces of a cubemap are not counted");
    TRY(check_counts(plain, pass, state));
    const CountingScene counting = TRY(counting_scene(scene, pass, weights));
    const glsl::WorkText& counted = counting.counted;
    std::vector<bool> wanted(counted.sites.size(), !weights.both_sides);
    for (const glsl::WorkBlock& block : counted.blocks)
        if (block.around)
            wanted[block.site] = true;
    const Extent group = group_of(weights.lanes);
    const RunsOfSites runs = TRY(runs_of_sites(counting, rewritten_pass(scene, pass), wanted, state, group));
    const size_t groups = size_t((state.extent.width + group.width - 1) / group.width) *
                          size_t((state.extent.height + group.height - 1) / group.height);
    BlockRuns blocks(counted, runs, groups);
    for (size_t site = 0; site < counted.sites.size(); ++site) {
        double times = 0;
        if (weights.both_sides)
            for (const double each : blocks.of(counted.sites[site].block))
                times += each;
        else
            for (const float each : runs[site])
                times += double(each);
        for (const auto& [where, weight] : counted.sites[site].lines)
            work[{where.file, where.line}] += times * weights.lanes * weight;
    }
    return {};
}

/// Returns the passes whose lines are counted, without sounds.
std::vector<size_t> counted_passes(const render::Renderer& plain, const std::string& only) {
    std::vector<size_t> passes;
    for (const render::PlannedPass& planned : plain.plan().passes)
        if (only.empty() || plain.scene().passes[planned.pass].name == only)
            passes.push_back(planned.pass);
    return passes;
}

// The second part measures: each of the counted lines is done twice in a text of its own, which is drawn in
// turn with the plain one.

/// CPU time of a drawing that is long enough to compare; the picture is drawn larger or smaller to come near.
constexpr double k_least_ms = 40, k_most_ms = 160;
constexpr int k_longest_side = 2560, k_shortest_side = 120;
constexpr size_t k_most_timed_rounds = 15;
/// Part of the time that may be spent on compiling.
constexpr double k_compiling = 0.6;

double seconds_of(const Stopwatch& clock) {
    return clock.elapsed().wall / 1000;
}

/// Returns whether the pictures have the same colours on a screen; of a buffer, the same numbers.
bool is_same_picture(const image::Image& one, const image::Image& other, bool of_screen) {
    const auto a = one.f32(), b = other.f32();
    if (!of_screen)
        return std::ranges::equal(
            a, b, [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
    for (size_t i = 0; i < a.size(); i += 4)
        if (bytes_of_colour(&a[i]) != bytes_of_colour(&b[i]))
            return false;
    return true;
}

/// A line of a pass, drawn by the text that does it twice and by its control.
struct Candidate {
    size_t line;   ///< index in HotLines::lines
    double factor; ///< the line's work for each part of it that is repeated
    StandIn twice, control;
    std::vector<double> more{}; ///< by each round: the additional time as a part of the pass's time
};

/// A pass of the frame: its own text, and those that do a line twice.
class PassBench {
public:
    PassBench(const PassPreview& preview, StandIn plain, bool by_cpu)
        : preview_(preview), plain_(std::move(plain)), by_cpu_(by_cpu) {}

    /// Returns the milliseconds of one drawing.
    double time(const StandIn& drawing) const {
        glFinish();
        const Stopwatch clock;
        drawing.draw(preview_);
        glFinish();
        return by_cpu_ ? clock.elapsed().cpu : clock.elapsed().wall;
    }
    double time_plain() {
        times_.push_back(time(plain_));
        return times_.back();
    }

    /// Adds a line if both of its texts draw the same picture.
    void add(size_t line, const glsl::LineTwice& made, bool of_screen) {
        auto twice = StandIn::link(preview_, made.text, "a text that does a line twice");
        if (!twice)
            return;
        auto control = StandIn::link(preview_, made.control, "a text that shifts a line's operands");
        if (control && keeps_picture(*twice, of_screen) && keeps_picture(*control, of_screen))
            candidates_.push_back({line, made.work / made.repeated, *std::move(twice), *std::move(control)});
    }

    /// Times the plain text and all candidates once.
    void round(size_t number) {
        const double plain = time_plain();
        for (const size_t i : shuffled(candidates_.size(), unsigned(number))) {
            Candidate& each = candidates_[i];
            const bool first = (number + i) % 2 == 0;
            const double before = first ? 0 : time(each.control);
            const double twice = time(each.twice);
            const double control = first ? time(each.control) : before;
            each.more.push_back(plain > 0 ? (twice - control) / plain : 0);
        }
    }

    const std::vector<Candidate>& candidates() const { return candidates_; }
    double milliseconds() const { return median(times_); }

private:
    bool keeps_picture(const StandIn& drawing, bool of_screen) {
        if (!picture_) {
            plain_.draw(preview_);
            picture_ = plain_.picture();
        }
        drawing.draw(preview_);
        return is_same_picture(*picture_, drawing.picture(), of_screen);
    }

    const PassPreview& preview_;
    StandIn plain_;
    bool by_cpu_;
    std::optional<image::Image> picture_;
    std::vector<Candidate> candidates_;
    std::vector<double> times_;
};

class LineMeter {
public:
    LineMeter(const scene::Scene& scene, const render::FrameState& state, const glsl::WorkWeights& weights,
              double seconds)
        : scene_(scene), state_(state), weights_(weights), seconds_(seconds),
          by_cpu_(gl::is_software_renderer(gl::query_capabilities().renderer)) {}

    /// Measures the lines; those that cannot be keep their counted share.
    Result<void> run(const std::vector<size_t>& passes, HotLines& hot) {
        TRY(choose_extent());
        std::vector<double> times;
        std::vector<std::vector<std::pair<size_t, LineShare>>> shares;
        for (size_t i = 0; i < passes.size(); ++i) {
            const double until = seconds_ * double(i + 1) / double(passes.size());
            shares.emplace_back();
            times.push_back(TRY(measure(passes[i], hot, until, shares.back())));
        }
        double all = 0;
        for (const double each : times)
            all += each;
        std::map<size_t, LineShare> sums;
        for (size_t i = 0; i < times.size(); ++i)
            for (const auto& [line, share] : shares[i]) {
                LineShare& sum = sums[line];
                sum.share += share.share * times[i] / all;
                sum.interval.low += share.interval.low * times[i] / all;
                sum.interval.high += share.interval.high * times[i] / all;
            }
        for (const auto& [line, sum] : sums) {
            hot.lines[line].share = std::max(0.0, sum.share);
            hot.lines[line].interval = sum.interval;
        }
        hot.measured = !sums.empty();
        return {};
    }

private:
    Result<render::Renderer> renderer() const {
        return render::Renderer::create(scene_, {.extent = state_.extent,
                                                 .samples = image::SampleType::f32,
                                                 .pass = state_.pass,
                                                 .specialise = glsl::Specialise::unreachable});
    }

    /// Changes the size so that a frame takes long enough to compare, and not longer than needed.
    Result<void> choose_extent() {
        auto drawn = TRY(renderer());
        if (drawn.plan().feedback)
            return {};
        const PassPreview preview(drawn, drawn.shown_index(), render::inputs_of(state_));
        const auto text = TRY(read_text(drawn, drawn.shown_index()));
        PassBench bench(preview, TRY(StandIn::link(preview, glsl::do_no_line_twice(*text), "the text")),
                        by_cpu_);
        bench.time_plain();
        double ms = bench.time_plain();
        const auto resize = [&](double factor) {
            const auto side = [&](int length) { return std::max(1, int(std::lround(length * factor))); };
            state_.extent = {side(state_.extent.width), side(state_.extent.height)};
            ms *= factor * factor;
        };
        while (ms < k_least_ms && 2 * std::max(state_.extent.width, state_.extent.height) <= k_longest_side)
            resize(2);
        while (ms > k_most_ms && std::min(state_.extent.width, state_.extent.height) >= 2 * k_shortest_side)
            resize(0.5);
        return {};
    }

    /// Returns the milliseconds of the pass. Adds what its lines take of them.
    Result<double> measure(size_t pass, const HotLines& hot, double until,
                           std::vector<std::pair<size_t, LineShare>>& shares) {
        auto drawn = TRY(renderer());
        const auto text = TRY(read_text(drawn, pass));
        const auto facts = glsl::find_facts(*text);
        const auto counted = TRY(glsl::count_operations(*text, facts, glsl::WorkAnswer::sites, weights_));
        const PassPreview preview =
            render::FrameStepper(drawn, state_, first_frame_of(state_)).preview(state_.frame, pass);
        PassBench bench(preview, TRY(StandIn::link(preview, glsl::do_no_line_twice(*text), "the text")),
                        by_cpu_);
        bench.time_plain(); // compiles
        const bool of_screen = scene_.passes[pass].kind == scene::PassKind::image;
        const double start = seconds_of(clock_);
        for (size_t line = 0; line < hot.lines.size(); ++line) {
            if (seconds_of(clock_) > start + k_compiling * (until - start))
                break;
            if (const auto made = glsl::do_line_twice(*text, facts, counted, hot.lines[line].where, weights_))
                bench.add(line, *made, of_screen);
        }
        size_t rounds = 0;
        for (; rounds < k_most_timed_rounds && (rounds < k_fewest_runs || seconds_of(clock_) < until);
             ++rounds)
            bench.round(rounds);
        for (const Candidate& each : bench.candidates())
            shares.emplace_back(each.line, measured_share(each.more, each.factor));
        return bench.milliseconds();
    }

    const scene::Scene& scene_;
    render::FrameState state_;
    const glsl::WorkWeights& weights_;
    double seconds_;
    bool by_cpu_;
    Stopwatch clock_;
};

/// Counted lines beyond those that are wanted, because a measured share may be larger.
constexpr size_t k_more_candidates = 2;

} // namespace

LineShare measured_share(const std::vector<double>& more, double factor) {
    const Interval interval = bootstrap_median(more);
    return {factor * median(more), {factor * interval.low, factor * interval.high}};
}

Result<HotLines> hot_lines(const scene::Scene& scene, const render::FrameState& state, size_t most,
                           const glsl::WorkWeights& weights, double seconds) {
    HotLines hot{.basis = basis_of(weights)};
    WorkOfLines work;
    auto plain = TRY(render::Renderer::create(scene, {.extent = state.extent,
                                                      .samples = image::SampleType::f32,
                                                      .pass = state.pass,
                                                      .specialise = glsl::Specialise::unreachable}));
    render::FrameStepper(plain, state, first_frame_of(state)).draw(state.frame);
    const std::vector<size_t> passes = counted_passes(plain, state.pass);
    std::vector<size_t> measured;
    for (const size_t pass : passes)
        if (auto added = add_work(plain, pass, state, weights, work); !added) {
            if (passes.size() == 1)
                return fail(std::move(added.error()));
            hot.not_counted.push_back(
                fmt::format("{}: {}", scene.passes[pass].name, reason_of(added.error())));
        } else {
            measured.push_back(pass);
        }
    double all = 0;
    for (const auto& [place, sum] : work)
        all += sum;
    hot.operations = all / double(state.extent.pixels());
    const auto texts = lines_of_texts(scene);
    for (const auto& [place, sum] : work) {
        const auto text = texts.find(place);
        hot.lines.push_back({{place.first, place.second},
                             text == texts.end() ? std::string() : text->second,
                             all > 0 ? sum / all : 0,
                             all > 0 ? sum / all : 0});
    }
    std::ranges::stable_sort(hot.lines, std::greater<>(), &HotLine::share);
    if (seconds > 0) {
        hot.lines.resize(std::min(hot.lines.size(), most + k_more_candidates));
        TRY(LineMeter(scene, state, weights, seconds).run(measured, hot));
        std::ranges::stable_sort(hot.lines, std::greater<>(), &HotLine::share);
    }
    hot.lines.resize(std::min(hot.lines.size(), most));
    return hot;
}

} // namespace tidemark::lab
