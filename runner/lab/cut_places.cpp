#include "base/error.hpp"
#include "lab/instrumented_pass.hpp"
#include "lab/probe_inputs.hpp"
#include "lab/scene_numbers.hpp"
#include "lab/simplify.hpp"
#include "lab/text_findings.hpp"
#include "render/frame_plan.hpp"
#include "render/frame_stepper.hpp"
#include "render/gl_context.hpp"
#include "scene/host_uniforms.hpp"
#include "shader/cuts.hpp"
#include "shader/rewrite.hpp"
#include "shader/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <tuple>

namespace tidemark::lab {
namespace {

/// Limit for one pass: each expression costs one drawing of every view.
constexpr size_t k_most_replaced = 32;

/// The mean of an expression's last values, component by component.
struct Mean {
    std::array<double, 4> sums{};
    double count = 0;

    void add(const image::Image& picture) {
        const auto samples = picture.f32();
        for (size_t i = 0; i + 3 < samples.size(); i += 4) {
            if (!std::isfinite(samples[i] + samples[i + 1] + samples[i + 2] + samples[i + 3]))
                continue;
            for (size_t k = 0; k < 4; ++k)
                sums[k] += samples[i + k];
            ++count;
        }
    }
    std::vector<double> values(int number) const {
        std::vector<double> values;
        for (int k = 0; k < number; ++k)
            values.push_back(sums[size_t(k)] / count);
        return values;
    }
};

/// A pass's text, parsed.
struct Followed {
    std::unique_ptr<const glsl::ParsedText> text;
    glsl::TreeFacts facts;
    glsl::Cutter cutter;

    explicit Followed(std::unique_ptr<const glsl::ParsedText> read)
        : text(std::move(read)), facts(glsl::find_facts(*text)), cutter(*text, facts) {}
};

/// Returns the samplers by which a pass reads the buffer `read`; nullopt if a sampler depends on the buffer's
/// size (mipmaps or mirrored repeat).
std::optional<std::vector<glsl::BufferSampler>> samplers_of(const scene::Pass& pass, size_t read) {
    std::vector<glsl::BufferSampler> samplers;
    for (size_t i = 0; i < pass.channels.size(); ++i) {
        const scene::Channel& channel = pass.channels[i];
        const size_t* const source = scene::source_pass(channel.input);
        if (!source || *source != read)
            continue;
        if (channel.sampling.mipmaps != scene::Mipmaps::none || channel.sampling.wrap == scene::Wrap::mirror)
            return std::nullopt;
        samplers.push_back({scene::k_channel_names[i], channel.sampling.wrap == scene::Wrap::repeat});
    }
    return samplers;
}

class PlaceFinder {
public:
    PlaceFinder(const scene::Scene& scene, const std::vector<View>& views, const KeepGoing& keep_going)
        : scene_(scene), views_(views), keep_going_(keep_going) {}

    Result<CutPlaces> run(Extent extent) {
        auto renderer =
            TRY(render::Renderer::create(scene_, {.extent = extent, .samples = image::SampleType::f32}));
        for (const render::PlannedPass& planned : renderer.plan().passes)
            add_pass(renderer, planned.pass);
        for (const auto& [pass, followed] : followed_)
            if (scene_.passes[pass].kind == scene::PassKind::buffer)
                add_half_size(pass);
        std::ranges::stable_sort(found_.cuts, std::greater<>(), [](const glsl::Cut& cut) {
            return std::pair(cut.keeps_values, cut.work * cut.chance);
        });
        return std::move(found_);
    }

private:
    void add_pass(render::Renderer& renderer, size_t pass) {
        const std::string& name = scene_.passes[pass].name;
        auto text = read_text(renderer, pass, true);
        if (!text) {
            found_.left.push_back(
                fmt::format("{}: the text cannot be analysed: {}", name, to_string(text.error())));
            return;
        }
        const Followed& followed = followed_.try_emplace(pass, *std::move(text)).first->second;
        const auto& [parsed, facts, cutter] = followed;
        for (const glsl::NodeId loop : cutter.endless()) {
            const SourceLocation where = parsed->spelled(parsed->tree()[loop].begin);
            found_.left.push_back(fmt::format("{}:{}: this loop may be endless by its head: its body and the "
                                              "functions that it calls are left unchanged",
                                              where.file, where.line));
        }
        for (glsl::Cut& cut : cutter.cuts())
            add(std::move(cut));
        for (glsl::Cut& cut : cutter.levels(which_have_mipmaps(scene_.passes[pass])))
            add(std::move(cut));
        if (auto cut = glsl::once_a_pixel(*parsed, facts, cutter.work()))
            add(*std::move(cut));
        if (scene_.passes[pass].kind != scene::PassKind::cubemap)
            add_replaced(renderer, pass, *parsed, cutter);
    }

    void add_half_size(size_t buffer) {
        std::vector<glsl::BufferReader> readers;
        size_t own = 0;
        for (size_t pass = 0; pass < scene_.passes.size(); ++pass) {
            const auto samplers = samplers_of(scene_.passes[pass], buffer);
            const auto followed = followed_.find(pass);
            if (!samplers || (followed == followed_.end() && !samplers->empty()))
                return;
            if (pass == buffer)
                own = readers.size();
            if (followed != followed_.end())
                readers.push_back({*followed->second.text, followed->second.facts, *samplers});
        }
        if (auto cut = glsl::half_size(readers, own, followed_.at(buffer).cutter.work()))
            add(*std::move(cut));
    }

    /// Adds a cut once: Common is part of several passes.
    void add(glsl::Cut cut) {
        const glsl::Wrap& wrap = cut.change.wraps.front();
        std::string words;
        for (const glsl::Wrap& each : cut.change.wraps)
            words += each.front;
        const auto place = [](const glsl::WrittenWord& word) {
            return std::tuple(word.where.file, word.where.line, word.where.column);
        };
        if (known_.insert({place(wrap.first), place(wrap.last), words}).second)
            found_.cuts.push_back(std::move(cut));
    }

    void add_replaced(render::Renderer& renderer, size_t pass, const glsl::ParsedText& text,
                      const glsl::Cutter& cutter) {
        std::vector<glsl::Replaceable> all = cutter.replaceables();
        all.resize(std::min(all.size(), k_most_replaced));
        const auto means = means_of(renderer, pass, text, all);
        if (!means) {
            found_.left.push_back(fmt::format("{}: no expression was replaced by a number: {}",
                                              scene_.passes[pass].name, to_string(means.error())));
            return;
        }
        for (size_t i = 0; i < means->size(); ++i)
            if ((*means)[i].count > 0)
                add(cutter.replaced(all[i], (*means)[i].values(all[i].type.rows)));
    }

    /// Returns the means over all views; empty if the text has no place for them.
    Result<std::vector<Mean>> means_of(render::Renderer& renderer, size_t pass, const glsl::ParsedText& text,
                                       const std::vector<glsl::Replaceable>& all) {
        std::vector<glsl::NodeId> nodes;
        for (const glsl::Replaceable& each : all)
            nodes.push_back(each.node);
        const glsl::SeenValues seen = glsl::see_values(text, nodes, glsl::k_output);
        std::vector<Mean> means(seen.text.empty() ? 0 : all.size());
        std::optional<StandIn> stand_in;
        for (const View& view : views_) {
            if (means.empty() || !keep_going_())
                break;
            const render::FrameState state = state_of(view, renderer.extent());
            const PassPreview preview = render::FrameStepper(renderer, state).preview(state.frame, pass);
            if (!stand_in)
                stand_in = TRY(StandIn::link(preview, seen.text, "the text that shows its values"));
            for (size_t i = 0; i < means.size() && keep_going_(); ++i) {
                stand_in->set(seen.which_uniform, double(i));
                stand_in->draw(preview);
                means[i].add(stand_in->picture());
            }
        }
        return means;
    }

    const scene::Scene& scene_;
    const std::vector<View>& views_;
    const KeepGoing& keep_going_;
    CutPlaces found_{};
    std::map<size_t, Followed> followed_{}; ///< by pass
    std::set<std::tuple<std::tuple<std::string, int, int>, std::tuple<std::string, int, int>, std::string>>
        known_{};
};

std::pair<int, int> begin_of(const glsl::Wrap& wrap) {
    return {wrap.first.where.line, wrap.first.where.column};
}
std::pair<int, int> end_of(const glsl::Wrap& wrap) {
    return {wrap.last.where.line, wrap.last.where.column};
}

} // namespace

Result<CutPlaces> find_cuts(const scene::Scene& scene, const std::vector<View>& views, Extent extent,
                            const KeepGoing& keep_going) {
    return PlaceFinder(scene, views, keep_going).run(extent);
}

bool is_inside(const glsl::Cure& inner, const glsl::Cure& outer) {
    const auto within = [](const glsl::Wrap& in, const glsl::Wrap& out) {
        return out.replaces && in.first.where.file == out.first.where.file && begin_of(out) <= begin_of(in) &&
               end_of(in) <= end_of(out);
    };
    const auto replaced = [&](const glsl::Wrap& in) {
        return std::ranges::any_of(outer.wraps, [&](const glsl::Wrap& out) { return within(in, out); });
    };
    const auto excluded = [&](const glsl::Wrap& in) {
        return in.replaces && std::ranges::any_of(outer.wraps, [&](const glsl::Wrap& out) {
                   return within(in, out) && within(out, in);
               });
    };
    return std::ranges::all_of(inner.wraps, replaced) || std::ranges::any_of(inner.wraps, excluded);
}

namespace {

constexpr size_t k_fewest_trials = 3, k_most_trials = 25;
constexpr double k_enough_milliseconds = 120; ///< for the timing rounds
/// The same by wall clock where CPU times are compared, which a busy machine stretches.
constexpr double k_longest_milliseconds = 480;
/// A long trial is not timed again if one round takes more than this share of the former time by both clocks.
constexpr double k_hopeless = 1.1;
/// Limit of the other views, and their last moment in seconds: later a float's rounding shows in many scenes.
constexpr size_t k_most_others = 160;
constexpr double k_latest_moment = 1000;
/// A picture is divided into this many parts; the RMSE of each may be this many times the allowed error.
constexpr int k_part_columns = 16, k_part_rows = 9;
constexpr double k_most_in_a_part = 3;

/// Small differences that the measure rounds to zero count as more than zero.
double error_of(Measure measure, const Outcome& outcome) {
    if (outcome.picture.samples.equal())
        return 0;
    return std::max(error_by(measure, outcome), std::numeric_limits<double>::min());
}

double displayed(const image::Image& picture, int x, int y, int channel) {
    const size_t i =
        (size_t(y) * size_t(picture.extent.width) + size_t(x)) * size_t(picture.channels) + size_t(channel);
    return std::clamp(double(picture.f32()[i]), 0.0, 1.0);
}

/// Returns how far `value` lies outside of what the picture shows at the pixel and its eight neighbours.
double gap_around(double value, const image::Image& picture, int x, int y, int channel) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (int j = std::max(0, y - 1); j <= std::min(y + 1, picture.extent.height - 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(x + 1, picture.extent.width - 1); ++i) {
            const double near = displayed(picture, i, j, channel);
            least = std::min(least, near);
            most = std::max(most, near);
        }
    return std::max({0.0, least - value, value - most});
}

/// Returns the RMSE of a part as displayed. An edge that moves by one pixel does not count: it is in both
/// pictures.
double rmse_of_part(const image::Image& own, const image::Image& cut, int part) {
    const auto [width, height] = own.extent;
    const int column = part % k_part_columns, row = part / k_part_columns;
    double squares = 0;
    size_t samples = 0;
    for (int y = height * row / k_part_rows; y < height * (row + 1) / k_part_rows; ++y)
        for (int x = width * column / k_part_columns; x < width * (column + 1) / k_part_columns; ++x)
            for (int k = 0; k < own.channels; ++k) {
                ++samples;
                const double before = displayed(own, x, y, k), after = displayed(cut, x, y, k);
                if (before == after)
                    continue;
                const double gap =
                    std::max(gap_around(before, cut, x, y, k), gap_around(after, own, x, y, k));
                squares += gap * gap;
            }
    return std::sqrt(squares / double(std::max<size_t>(1, samples)));
}

} // namespace

bool keeps_parts(const Goal& goal, const image::Image& own, const image::Image& cut) {
    for (int part = 0; part < k_part_columns * k_part_rows; ++part)
        if (rmse_of_part(own, cut, part) > k_most_in_a_part * *goal.most_error)
            return false;
    return true;
}

std::vector<View> other_views(const scene::Scene& scene, const std::vector<View>& views, size_t most) {
    const auto reads = [&](std::string_view name) {
        return std::ranges::any_of(scene.passes, [&](const scene::Pass& pass) {
            return (scene.common.text() + pass.text.text()).find(name) != std::string::npos;
        });
    };
    double last = k_latest_moment;
    if (render::may_have_feedback(scene))
        last = std::ranges::max(views, {}, [](const View& view) {
                   return view.state.seconds();
               }).state.seconds();
    const Promises promises;
    const SearchSpace space(scene, promises, {true, reads("iMouse")});
    std::vector<View> others;
    for (const SearchPoint& point : space.survey()) {
        if (others.size() >= most)
            break;
        if (point.time > last || point.knobs != space.plain().knobs)
            continue;
        View view{.name = fmt::format("t={:g}", point.time), .state = render::at_time(point.time)};
        view.mouse = point.mouse.value_or(glm::dvec2(0));
        others.push_back(std::move(view));
    }
    return others;
}

namespace {

/// Bits of one uniform: each switches one cut.
constexpr size_t k_bits = 30;
/// A text that the driver refuses is halved until the cuts at fault are found, at most so often.
constexpr size_t k_most_refusals = 16;

std::string name_of_switches(size_t number) {
    return fmt::format("tidemark_cuts{}", number);
}

std::string replaced(std::string text, char sign, const std::string& with) {
    for (size_t at = text.find(sign); at != text.npos; at = text.find(sign, at + with.size()))
        text.replace(at, 1, with);
    return text;
}

/// Returns the switched form of the cut for that bit.
glsl::Cure switched(const glsl::Cut& cut, size_t bit) {
    const std::string test =
        fmt::format("(({} & {}) != 0)", name_of_switches(bit / k_bits), size_t(1) << (bit % k_bits));
    glsl::Cure cure{cut.switched, cut.change.reason};
    for (glsl::Wrap& wrap : cure.wraps)
        for (std::string* const text : {&wrap.front, &wrap.behind})
            *text = replaced(replaced(*text, '$', test), '@', fmt::format("{}", bit));
    return cure;
}

} // namespace

std::optional<CutSwitches> CutSwitches::link(const scene::Scene& scene, Extent extent,
                                             std::span<const glsl::Cut> cuts, std::vector<size_t> which) {
    std::vector<glsl::Cure> cures;
    for (size_t bit = 0; bit < which.size(); ++bit)
        cures.push_back(switched(cuts[which[bit]], bit));
    auto whole = changed(scene, cures);
    if (!whole)
        return std::nullopt;
    const size_t first = whole->knobs.size();
    for (size_t number = 0; number * k_bits < which.size(); ++number)
        whole->knobs.push_back({.name = name_of_switches(number), .type = scene::KnobType::int1});
    auto specimen = Specimen::create(*whole, {}, extent, HitSource::none);
    if (!specimen)
        return std::nullopt;
    return CutSwitches(*std::move(specimen), std::move(which), std::move(whole->knobs), first);
}

std::optional<CutSwitches> CutSwitches::create(const scene::Scene& scene, Extent extent,
                                               std::span<const glsl::Cut> cuts, std::vector<size_t> which,
                                               const KeepGoing& keep_going) {
    std::ranges::sort(which);
    std::vector<std::vector<size_t>> left{std::move(which)}; // to be tried
    std::vector<size_t> accepted;
    size_t refusals = 0;
    while (!left.empty() && refusals < k_most_refusals && keep_going()) {
        std::vector<size_t> part = std::move(left.back());
        left.pop_back();
        if (part.empty())
            continue;
        auto linked = link(scene, extent, cuts, part);
        if (linked && refusals == 0)
            return linked;
        if (linked) {
            std::ranges::move(part, std::back_inserter(accepted));
            continue;
        }
        ++refusals;
        if (part.size() == 1)
            continue;
        const auto middle = part.begin() + std::ptrdiff_t(part.size() / 2);
        left.emplace_back(middle, part.end());
        left.emplace_back(part.begin(), middle);
    }
    std::ranges::sort(accepted);
    return accepted.empty() ? std::nullopt : link(scene, extent, cuts, std::move(accepted));
}

void CutSwitches::make(std::span<const size_t> cuts) {
    for (size_t number = first_; number < knobs_.size(); ++number)
        knobs_[number].value = {};
    for (const size_t cut : cuts) {
        const auto place = std::ranges::lower_bound(which_, cut);
        const auto bit = size_t(place - which_.begin());
        assert(place != which_.end() && *place == cut);
        knobs_[first_ + bit / k_bits].value[0] += double(size_t(1) << (bit % k_bits));
    }
    specimen_.turn(knobs_);
}

CutBench::CutBench(const scene::Scene& scene, Extent extent, std::vector<View> views, Specimen own)
    : scene_(&scene), extent_(extent), views_(std::move(views)), own_(std::move(own)),
      by_cpu_(gl::is_software_renderer(gl::query_capabilities().renderer)) {}

Result<CutBench> CutBench::create(const scene::Scene& scene, Extent extent, std::vector<View> views,
                                  double seconds) {
    auto own = TRY(Specimen::create(scene, {}, extent));
    CutBench bench(scene, extent, std::move(views), std::move(own));
    const Stopwatch drawing;
    bench.truth_ = TRY(truth_of(bench.own_.pictures(bench.views_)));
    const double later = drawing.elapsed().wall - bench.own_.first_draw_milliseconds();
    bench.draw_seconds_ = later * 1e-3 / double(std::max<size_t>(1, bench.views_.size() - 1));
    bench.compile_seconds_ =
        (bench.own_.compile_milliseconds() + bench.own_.first_draw_milliseconds()) * 1e-3;
    const Stopwatch clock;
    for (const View& view : other_views(scene, bench.views_, k_most_others)) {
        if (clock.elapsed().wall * 1e-3 > seconds)
            break;
        if (auto truth = truth_of(bench.own_.pictures({view}))) {
            bench.other_views_.push_back(view);
            bench.other_truths_.push_back(*std::move(truth));
        }
    }
    return bench;
}

/// Returns the error in the worst view, or nothing if it exceeds the goal.
std::optional<double> CutBench::error_in(Specimen& specimen, std::span<const View> views, const Truth& truth,
                                         const Goal& goal) const {
    Sight sight;
    const bool all_at_once = render::may_have_feedback(*scene_); // each picture starts at frame 0
    if (all_at_once)
        sight.pictures = as_shown(specimen.pictures({views.begin(), views.end()}));
    double worst = 0;
    for (size_t view = 0; view < views.size(); ++view) {
        if (!all_at_once)
            sight.pictures.push_back(as_shown({specimen.picture(views[view])}).front());
        if (truth.pictures[view].bytes == sight.pictures[view].bytes)
            continue;
        if (!keeps_parts(goal, truth.pictures[view], sight.pictures[view])) // cheaper than the measure
            return std::nullopt;
        const double error = error_of(goal.measure, outcome_of(sight, truth, view));
        if (!(error <= *goal.most_error))
            return std::nullopt;
        worst = std::max(worst, error);
    }
    return worst;
}

bool CutBench::take_as_reference(CutSwitches& switches, const Goal& goal) {
    switches.make({});
    auto truth = truth_of(switches.specimen().pictures(views_));
    if (!truth || !error_in(switches.specimen(), views_, truth_, goal))
        return false;
    switches.truth = *std::move(truth);
    return true;
}

std::optional<double> CutBench::error_of_switched(CutSwitches& switches, std::span<const size_t> cuts,
                                                  const Goal& goal) {
    switches.make(cuts);
    return error_in(switches.specimen(), views_, switches.truth, goal);
}

double CutBench::time_of_switched(CutSwitches& switches, size_t cut) {
    double with = 0, without = 0;
    for (const View& view : views_) {
        switches.make(std::span(&cut, 1));
        with += clocked(switches.specimen().time(view, false).elapsed);
        switches.make({});
        without += clocked(switches.specimen().time(view, false).elapsed);
    }
    return with / without;
}

std::optional<CutTrial> CutBench::try_cuts(std::span<const glsl::Cure> cuts, Specimen& other,
                                           const Goal& goal, bool everywhere) {
    const auto scene = changed(*scene_, cuts);
    auto specimen = scene ? Specimen::create(*scene, {}, extent_) : fail(ErrorCode::load, "");
    if (!specimen)
        return std::nullopt;
    CutTrial trial{*std::move(specimen)};
    const auto error = error_in(trial.specimen, views_, truth_, goal);
    if (!error)
        return std::nullopt;
    trial.error = *error;
    trial.time = relative_time(trial.specimen, other);
    if (trial.time > k_pays || !everywhere)
        return trial;
    for (size_t i = 0; i < other_views_.size(); ++i) {
        const auto elsewhere =
            error_in(trial.specimen, std::span(&other_views_[i], 1), other_truths_[i], goal);
        if (!elsewhere)
            return std::nullopt;
        trial.error = std::max(trial.error, *elsewhere);
    }
    return trial;
}

double CutBench::milliseconds() {
    std::vector<double> rounds;
    for (size_t round = 0; round < k_fewest_trials; ++round) {
        double sum = 0;
        for (const View& view : views_)
            sum += own_.time(view, false).elapsed.wall;
        rounds.push_back(sum / double(views_.size()));
    }
    return median(rounds);
}

double CutBench::seconds_of_trial() {
    const auto drawn = double(views_.size() * (1 + 2 * k_fewest_trials));
    return milliseconds() * 1e-3 * drawn;
}

double CutBench::clocked(const Elapsed& elapsed) const {
    return by_cpu_ ? elapsed.cpu : elapsed.wall;
}

/// Returns the median ratio of the times, over rounds that draw both alternately.
double CutBench::relative_time(Specimen& one, Specimen& other) const {
    std::vector<double> ratios;
    Elapsed spent{};
    bool enough = false;
    for (size_t round = 0; round < k_most_trials && !(enough && round >= k_fewest_trials); ++round) {
        Elapsed sums[2]{};
        for (const View& view : views_)
            for (Specimen* const each : {&one, &other}) {
                const Elapsed elapsed = each->time(view, false).elapsed;
                sums[each == &other].wall += elapsed.wall;
                sums[each == &other].cpu += elapsed.cpu;
            }
        for (const Elapsed& sum : sums) {
            spent.wall += sum.wall;
            spent.cpu += sum.cpu;
        }
        ratios.push_back(clocked(sums[0]) / clocked(sums[1]));
        enough = std::min(spent.wall, clocked(spent)) > k_enough_milliseconds ||
                 spent.wall > k_longest_milliseconds;
        if (enough && sums[0].wall > k_hopeless * sums[1].wall && sums[0].cpu > k_hopeless * sums[1].cpu)
            break;
    }
    return median(ratios);
}

} // namespace tidemark::lab
