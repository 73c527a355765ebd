#include "lab/exploration.hpp"

#include "base/error.hpp"
#include "base/measurement.hpp"
#include "lab/probe_bench.hpp"
#include "lab/probe_inputs.hpp"
#include "lab/probed_pictures.hpp"
#include "lab/text_findings.hpp"
#include "scene/host_uniforms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <set>
#include <utility>

namespace tidemark::lab {

PixelGrid finer(const PixelGrid& grid, Extent part, uint32_t pixel, Extent whole) {
    const int x = grid.left + grid.stride * (int(pixel) % part.width);
    const int y = grid.down + grid.stride * (int(pixel) / part.width);
    const int stride = grid.stride > 4 ? 4 : 1;
    const auto first = [&](int middle, int size, int all) {
        return std::clamp(middle - stride * (size / 2), 0, all - 1 - stride * (size - 1));
    };
    return {stride, first(x, part.width, whole.width), first(y, part.height, whole.height)};
}

namespace {

constexpr Extent k_asked{640, 360}; ///< default size of `capture`
constexpr Extent k_part{32, 18};    ///< pixels drawn of it at a time
constexpr size_t k_most_confirmed = 3;
constexpr int k_most_edge_steps = 320; ///< golden-section steps towards edges
constexpr int k_steps_of_one = 14;
constexpr int k_rounds = 2;
constexpr size_t k_valleys = 3; ///< local minima over time that are followed per objective
constexpr size_t k_most_places = 40;

/// Milliseconds of CPU time after which each part of the search ends. The limit of wall-clock time is five
/// times as high.
constexpr double k_looks_end = 1000, k_steps_end = 1500, k_places_end = 1900, k_pictures_end = 2300;

/// A whole picture that would take longer, in milliseconds of CPU time, is not drawn.
constexpr double k_longest_picture = 5000;

constexpr float k_far = std::numeric_limits<float>::infinity();

std::string counted(size_t number, std::string_view what) {
    return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

/// The result of drawing all passes in one situation.
struct Look {
    SearchPoint point;
    std::vector<glsl::DomainRoom> rooms; ///< one per objective, passes in order
};

class Explorer {
public:
    explicit Explorer(ProbeBench& bench) : bench_(bench) {}

    Result<Explored> run() {
        TRY(prepare());
        const std::vector<SearchPoint> points = space_->survey();
        for (const SearchPoint& point : points) {
            if (is_over(k_looks_end))
                break;
            TRY(look(point, coarse()));
            if (looks_.size() == 1)
                watch_ = Stopwatch(); // leaves out the time for compiling
        }
        surveyed_ = looks_.size();
        // After a comparison went the other way, more objectives may come into reach.
        for (int round = 1; round <= k_rounds; ++round)
            TRY(step_to_edges(k_most_edge_steps * round / k_rounds));
        spent_ = watch_.elapsed().cpu;
        TRY(zoom_in());
        TRY(draw_whole());
        result_.sentence = sentence();
        return std::move(result_);
    }

private:
    struct WatchedPass {
        const PassText& text;
        WatchedDomains watched;
        size_t first; ///< its first objective
    };

    Result<void> prepare() {
        const auto renderer = TRY(bench_.compiled());
        SearchInputs inputs;
        for (const render::PlannedPass& planned : (renderer)->plan().passes) {
            const bool other_hosts = (renderer)->names_of(planned.pass).other_hosts;
            for (const gl::Uniform& uniform : (renderer)->program(planned.pass).reflection().uniforms)
                if (const auto* row = scene::find_host_uniform(uniform.name, other_hosts)) {
                    inputs.time = inputs.time || row->follows == scene::Follows::clock;
                    inputs.mouse = inputs.mouse || row->follows == scene::Follows::mouse;
                }
        }
        space_.emplace(bench_.scene(), bench_.promises(), inputs);
        auto texts = read_texts(bench_, false);
        if (!texts) {
            result_.left_out = to_string(texts.error());
            extent_ = k_probe_extent;
            return {};
        }
        // With several passes or feedback, each look also draws what it depends on: use a small picture.
        texts_ = *std::move(texts);
        extent_ = texts_.size() > 1 || (renderer)->plan().feedback ? k_probe_extent : k_asked;
        for (const PassText& text : texts_)
            if (auto watched = watch(text); !watched) {
                result_.left_out = to_string(watched.error());
                passes_.clear();
                reached_.clear();
                extent_ = k_probe_extent;
                return {};
            }
        return {};
    }

    Result<void> watch(const PassText& text) {
        const auto preview = TRY(bench_.preview(plain_state(), text.pass));
        auto watched = TRY(WatchedDomains::link(preview, text, k_part));
        for (size_t i = 0; i < watched.watch().objectives.size(); ++i)
            reached_.push_back(false);
        const size_t first = reached_.size() - watched.watch().objectives.size();
        passes_.push_back({text, std::move(watched), first});
        return {};
    }

    bool is_over(double milliseconds) const {
        const Elapsed elapsed = watch_.elapsed();
        over_ = over_ || elapsed.cpu > milliseconds || elapsed.wall > 5 * milliseconds;
        return elapsed.cpu > milliseconds || elapsed.wall > 5 * milliseconds;
    }

    PixelGrid coarse() const {
        const int stride = extent_.width / k_part.width;
        return {stride, stride / 2, stride / 2};
    }

    /// Draws all passes in that situation and records new findings; `last_` receives the result.
    Result<void> look(const SearchPoint& point, const PixelGrid& grid) {
        const FrameState at = space_->state(point, extent_);
        last_ = {point, {}};
        if (passes_.empty()) {
            looks_.push_back(last_);
            return confirm(at);
        }
        finite_ = true;
        for (WatchedPass& pass : passes_) {
            const auto preview = TRY(bench_.preview(at, pass.text.pass));
            note(pass, preview, grid, at);
        }
        if (grid.stride == coarse().stride)
            looks_.push_back(last_);
        if (finite_ || confirmed_ == k_most_confirmed)
            return {};
        ++confirmed_;
        return confirm(at);
    }

    void note(WatchedPass& pass, const PassPreview& preview, const PixelGrid& grid, const FrameState& at) {
        const glsl::DomainWatch& watch = pass.watched.watch();
        const std::vector<uint32_t> words = pass.watched.draw(preview, grid);
        const bool finite = pass.watched.finite();
        for (size_t i = 0; i < watch.objectives.size(); ++i) {
            const glsl::Objective& objective = watch.objectives[i];
            const glsl::DomainRoom& room = last_.rooms.emplace_back(room_of(watch, words, i));
            if (watch.sites[objective.site].kind == glsl::DomainKind::comparison)
                reach(pass.first + i, objective.equality ? room.least == 0 : room.least < 0);
            else
                reach(pass.first + i, reading_of(watch, words, objective.site).count > 0 ||
                                          (watch.sites[objective.site].kind == glsl::DomainKind::quotient &&
                                           room.least == 0));
        }
        for (size_t i = 0; i < watch.sites.size(); ++i)
            if (const glsl::DomainReading reading = reading_of(watch, words, i);
                reading.count > 0 && outside_.insert({pass.text.pass, i}).second)
                record(pass, preview, grid, at, i, reading);
        finite_ = finite_ && finite;
    }

    void reach(size_t objective, bool reached) { reached_[objective] = reached_[objective] || reached; }

    /// Records a new site, with its operand in the first pixel that reached it.
    void record(WatchedPass& pass, const PassPreview& preview, const PixelGrid& grid, const FrameState& at,
                size_t site, glsl::DomainReading reading) {
        const glsl::DomainWatch& watch = pass.watched.watch();
        const std::string place = place_of_site(*pass.text.text, watch.sites[site]);
        if (place.empty())
            return;
        Outside& seen =
            result_.outside.emplace_back(Outside{at, grid, is_bound(watch.sites[site], reading), {}});
        if (pass.text.pass != bench_.scene().image_index())
            seen.where.pass = bench_.scene().passes[pass.text.pass].name;
        seen.place = location_of_site(*pass.text.text, watch.sites[site]);
        seen.pass = pass.text.pass;
        seen.site = watch.sites[site];
        if (!seen.bound)
            return;
        const glm::ivec2 pixel = pass.watched.pixel(grid, reading.pixel);
        const auto alone = reading_of(watch, pass.watched.draw(preview, {0, pixel.x, pixel.y}), site);
        if (alone.count > 0)
            reading = alone;
        seen.what = domain_sentence(*pass.text.text, watch.sites[site], reading);
        seen.sentence = fmt::format("{}: {}, at pixel {},{} at {:.6g} s", place, seen.what, pixel.x, pixel.y,
                                    at.seconds());
    }

    /// Draws the scene's own text, all of its pixels, to confirm that a pass is not finite.
    Result<void> confirm(const FrameState& at) {
        if (!result_.not_finite.empty())
            return {};
        const auto passes = TRY(bench_.passes(at));
        if (not_finite(bench_, at, passes))
            result_.not_finite.push_back(at);
        return {};
    }

    /// A situation from which to step towards an objective.
    struct Start {
        size_t objective;
        SearchPoint point;
        double low, high; ///< neighbouring moments, which are farther away
        double score;
    };

    bool is_way(size_t objective) const {
        const auto pass = std::ranges::find_if(passes_, [&](const WatchedPass& each) {
            return objective < each.first + each.watched.watch().objectives.size();
        });
        const glsl::DomainWatch& watch = pass->watched.watch();
        return watch.sites[watch.objectives[objective - pass->first].site].kind ==
               glsl::DomainKind::comparison;
    }

    /// Returns the looks with default knobs and without the mouse, in the order of their moments.
    std::vector<const Look*> time_line() const {
        const SearchPoint plain = space_->plain();
        std::vector<const Look*> line;
        for (const Look& each : looks_)
            if (each.point.knobs == plain.knobs && !each.point.mouse)
                line.push_back(&each);
        std::ranges::sort(line, {}, [](const Look* each) { return each->point.time; });
        return line;
    }

    /// Returns no starts if no input that the scene reads changes the objective.
    std::vector<Start> starts_of(size_t objective, const std::vector<const Look*>& line) const {
        float least = k_far, most = -k_far;
        size_t zeros = 0;
        const Look* best = nullptr;
        for (const Look& each : looks_) {
            const float room = each.rooms[objective].least;
            if (room == k_far)
                continue;
            zeros += room == 0;
            most = std::max(most, room);
            if (room < least) {
                least = room;
                best = &each;
            }
        }
        // An objective that is often exactly 0 is kept there by a max() or a clamp().
        if (!best || !(most > least) || zeros > looks_.size() / 4)
            return {};
        std::vector<Start> starts;
        const double score = double(least) / (double(most) - double(least));
        for (size_t i = 0; i < line.size(); ++i) {
            const float room = line[i]->rooms[objective].least;
            const float before = i > 0 ? line[i - 1]->rooms[objective].least : k_far;
            const float after = i + 1 < line.size() ? line[i + 1]->rooms[objective].least : k_far;
            if (room != k_far && room <= before && room <= after && (room < before || room < after))
                starts.push_back({objective, line[i]->point, line[i > 0 ? i - 1 : i]->point.time,
                                  line[i + 1 < line.size() ? i + 1 : i]->point.time,
                                  score + double(room - least) / (double(most) - double(least))});
        }
        std::ranges::sort(starts, {}, &Start::score);
        if (starts.size() > k_valleys)
            starts.erase(starts.begin() + k_valleys, starts.end());
        starts.insert(starts.begin(), {objective, best->point, best->point.time, best->point.time, score});
        return starts;
    }

    /// Returns whether the survey saw the objective change when only that knob did; true if the survey did
    /// not try that.
    bool moves(const SearchAxis& axis, size_t objective) const {
        const float plain = looks_.front().rooms[objective].least;
        if (axis.kind != SearchAxis::Kind::knob || plain == k_far)
            return true;
        SearchPoint point = looks_.front().point;
        bool tried = false;
        for (size_t i = 1; i < surveyed_; ++i) {
            const Look& each = looks_[i];
            SearchSpace::set(point, axis, SearchSpace::value(each.point, axis));
            if (each.point.time != point.time || each.point.mouse || each.point.knobs != point.knobs ||
                each.point.knobs == looks_.front().point.knobs)
                continue;
            if (each.rooms[objective].least != plain)
                return true;
            tried = true;
        }
        return !tried;
    }

    Result<void> step_to_edges(int most) {
        const std::vector<const Look*> line = time_line();
        std::vector<Start> starts;
        for (size_t i = 0; i < reached_.size(); ++i)
            if (!reached_[i])
                std::ranges::move(starts_of(i, line), std::back_inserter(starts));
        std::ranges::stable_sort(starts, {}, &Start::score);
        for (const Start& start : starts) {
            if (reached_[start.objective])
                continue;
            SearchPoint point = start.point;
            for (const SearchAxis& axis : space_->axes()) {
                if (reached_[start.objective] || steps_ >= most || is_over(k_steps_end))
                    break;
                if ((axis.kind == SearchAxis::Kind::time && start.low == start.high) ||
                    !moves(axis, start.objective))
                    continue;
                followed_.insert(start.objective);
                TRY(step(start, axis, point));
            }
        }
        return {};
    }

    /// Searches along one axis by golden section; `point` becomes the best point found.
    Result<void> step(const Start& start, const SearchAxis& axis, SearchPoint& point) {
        constexpr double k_ratio = 0.6180339887498949;
        const double here = SearchSpace::value(point, axis);
        const bool time = axis.kind == SearchAxis::Kind::time;
        const double reach = (axis.high - axis.low) / 6;
        double low = time ? start.low : std::max(axis.low, here - reach);
        double high = time ? start.high : std::min(axis.high, here + reach);
        const auto room_at = [&](double value) -> Result<float> {
            SearchPoint there = point;
            SearchSpace::set(there, axis, value);
            ++steps_;
            TRY(look(there, coarse()));
            return last_.rooms[start.objective].least;
        };
        double left = high - k_ratio * (high - low), right = low + k_ratio * (high - low);
        auto of_left = room_at(left), of_right = room_at(right);
        for (int i = 2; of_left && of_right && i < k_steps_of_one && !reached_[start.objective]; ++i) {
            if (*of_left == *of_right && i == 2 && !time)
                return {}; // the axis has no effect
            if (*of_left <= *of_right) {
                high = std::exchange(right, left);
                of_right = of_left;
                left = high - k_ratio * (high - low);
                of_left = room_at(left);
            } else {
                low = std::exchange(left, right);
                of_left = of_right;
                right = low + k_ratio * (high - low);
                of_right = room_at(right);
            }
        }
        if (!of_left || !of_right)
            return fail(!of_left ? of_left.error() : of_right.error());
        SearchSpace::set(point, axis, *of_left <= *of_right ? left : right);
        return {};
    }

    /// Draws the pixels around the nearest one, for each objective that was not reached.
    Result<void> zoom_in() {
        std::vector<std::pair<size_t, const Look*>> nearest;
        for (const bool ways : {false, true})
            for (size_t i = 0; i < reached_.size(); ++i) {
                if (reached_[i] || is_way(i) != ways)
                    continue;
                const Look* best = nullptr;
                for (const Look& each : looks_)
                    if (each.rooms[i].least != k_far && (!best || each.rooms[i].least < best->rooms[i].least))
                        best = &each;
                if (best)
                    nearest.emplace_back(i, best);
            }
        for (const auto& [objective, best] : nearest) {
            if (zooms_ == k_most_places || is_over(k_places_end))
                break;
            ++zooms_;
            PixelGrid grid = coarse();
            glsl::DomainRoom room = best->rooms[objective];
            while (grid.stride > 1 && room.least != k_far && !reached_[objective]) {
                grid = finer(grid, k_part, room.pixel, extent_);
                TRY(look(best->point, grid));
                room = last_.rooms[objective];
            }
        }
        return {};
    }

    Result<void> draw_whole() {
        for (const double time : {1.0, 0.0, 10.0, 60.0}) {
            if (!result_.not_finite.empty() ||
                (pictures_ > 0 && (is_over(k_pictures_end) || !reads_time())) ||
                whole_picture() > k_longest_picture)
                return {};
            const FrameState at = state_at(time, k_asked);
            const auto passes = TRY(bench_.passes(at));
            ++pictures_;
            if (not_finite(bench_, at, passes))
                result_.not_finite.push_back(at);
        }
        return {};
    }

    /// Returns the estimated CPU time of one whole picture in milliseconds, from the looks so far.
    double whole_picture() const {
        const auto pixels = double((extent_.width == k_asked.width ? k_part : extent_).pixels());
        return spent_ / double(std::max<size_t>(looks_.size(), 1)) * double(k_asked.pixels()) / pixels;
    }

    bool reads_time() const {
        return std::ranges::any_of(
            space_->axes(), [](const SearchAxis& axis) { return axis.kind == SearchAxis::Kind::time; });
    }

    std::string sentence() const {
        std::set<double> moments;
        size_t mouse = 0, knobs = 0;
        const SearchPoint plain = space_->plain();
        for (size_t i = 0; i < surveyed_; ++i) {
            const Look& each = looks_[i];
            moments.insert(each.point.time);
            mouse += each.point.mouse.has_value();
            knobs += each.point.knobs != plain.knobs;
        }
        std::string text = "sampled: " + counted(surveyed_, "situation");
        if (moments.size() > 1)
            text += fmt::format(", {} in {:.3g} to {:.6g} s", counted(moments.size(), "moment"),
                                *moments.begin(), *moments.rbegin());
        if (mouse > 0)
            text += fmt::format(", {} of the mouse", counted(mouse, "place"));
        if (knobs > 0)
            text += fmt::format(", {} of knobs", counted(knobs, "setting"));
        if (passes_.empty()) {
            text += fmt::format(", in {}x{} pixels", extent_.width, extent_.height);
        } else {
            text += fmt::format(", in {}x{} pixels of {}x{}", k_part.width, k_part.height, extent_.width,
                                extent_.height);
            const auto reached = std::ranges::count_if(followed_, [&](size_t i) { return reached_[i]; });
            if (steps_ > 0)
                text += fmt::format("; {} towards {}, {} reached", counted(size_t(steps_), "step"),
                                    counted(followed_.size(), "edge"), reached);
            if (zooms_ > 0)
                text += fmt::format("; {} pixel by pixel", counted(zooms_, "place"));
        }
        text +=
            fmt::format("; {} of {}x{}", counted(pictures_, "whole picture"), k_asked.width, k_asked.height);
        return over_ ? text + "; cut short: the scene is slow" : text;
    }

    ProbeBench& bench_;
    Stopwatch watch_;
    mutable bool over_ = false;
    std::optional<SearchSpace> space_;
    Extent extent_ = k_asked;
    std::vector<PassText> texts_;
    std::vector<WatchedPass> passes_;
    bool finite_ = true;        ///< in the last look
    std::vector<bool> reached_; ///< per objective
    std::set<size_t> followed_;
    std::set<std::pair<size_t, size_t>> outside_; ///< pass, site
    std::deque<Look> looks_;                      ///< at the coarse grid; those of the survey come first
    size_t surveyed_ = 0;
    Look last_;
    Explored result_;
    size_t confirmed_ = 0, zooms_ = 0, pictures_ = 0;
    int steps_ = 0;
    double spent_ = 0; ///< CPU time of all looks, milliseconds
};

} // namespace

Result<const Explored*> explore(ProbeBench& bench) {
    if (!bench.explored()) {
        auto found = TRY(Explorer(bench).run());
        bench.explored() = std::move(found);
    }
    return &*bench.explored();
}

} // namespace tidemark::lab
