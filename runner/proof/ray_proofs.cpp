#include "proof/ray_proofs.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>
#include <vector>

namespace tidemark::proof {
namespace {

constexpr double k_first_part = 1.0 / 16;
/// Share of the ray's length: longer pieces have too many open paths for a closer evaluation.
constexpr double k_looked_at = 1.0 / 256;
/// Share of the ray's length: a hit nearer to the start is narrowed down relative to that length, or to the
/// distance at the start if that is less.
constexpr double k_near_part = 1e-2;
/// How often the width is doubled in the search for a certain hit after a possible one.
constexpr int k_doublings = 10;
/// Allowance for rounding in quotients.
constexpr double k_shorter = 1 - 1e-12;
/// A piece whose field is this many times wider than its parameter counts as a jump.
constexpr double k_jump = 1e3;

/// Backs off from a method that failed: after each failure it is skipped twice as often as before (plus one),
/// up to 7 times in a row.
class Patience {
public:
    bool ask(bool needed) {
        if (!needed && left_ > 0) {
            --left_;
            return false;
        }
        return true;
    }
    void helped(bool did) {
        wait_ = did ? 0 : std::min(2 * wait_ + 1, k_longest);
        left_ = wait_;
    }

private:
    static constexpr int k_longest = 7;
    int wait_ = 0, left_ = 0;
};

class HitSearch {
public:
    HitSearch(MarchSlice& slice, double last, uint64_t most, double relative_width)
        : slice_(slice), last_(last), most_(most), relative_width_(relative_width),
          length_(last - slice.start()), near_(near()) {}

    FirstHit run() {
        if (!std::isfinite(length_))
            return answer(FirstHit::Verdict::undecided, everything(), FirstHit::Reason::not_finite);
        if (last_ == slice_.start())
            return at_start();
        double at = slice_.start();
        double width = length_ * k_first_part;
        while (at < last_) {
            const Interval cell{at, std::min(at + width, last_)};
            if (slice_.evaluations() >= most_)
                return answer(FirstHit::Verdict::undecided, cell, FirstHit::Reason::budget);
            const Look look = look_at(cell);
            at = look.free < cell.width() ? cell.low + look.free : cell.high;
            if (look.hit_by && *look.hit_by - at <= narrowest(at))
                return answer(FirstHit::Verdict::hit, {at, *look.hit_by}, FirstHit::Reason::none);
            if (at < cell.high && cell.width() <= narrowest(at))
                return at_narrow({at, cell.high});
            width = next_width(cell, look);
        }
        return answer(FirstHit::Verdict::none, {slice_.start(), last_}, FirstHit::Reason::none);
    }

private:
    double near() {
        const auto distance = slice_.distance(place_at(slice_.start()), Care::close);
        const bool known = distance && distance->low > 0;
        return std::min(k_near_part * length_, known ? distance->low : k_infinity);
    }
    double narrowest(double at) const { return relative_width_ * std::max(std::abs(at), near_); }

    /// The proved facts about a cell.
    struct Look {
        double free = 0;                ///< length from the cell's low end that has no hit
        std::optional<double> hit_by{}; ///< there is a hit at or before this place
    };

    /// If slopes excluded more of the last cell than bounds did, they are evaluated first. Methods that
    /// failed are not tried at every cell, except at the narrowest ones, where all are tried. Close
    /// evaluation costs one run for each path, so it comes last.
    Look look_at(const Interval& cell) {
        const Look all{cell.width()};
        const bool narrow = cell.width() <= narrowest(cell.low);
        const bool slopes_first = std::exchange(slopes_told_, false);
        if (!slopes_first && is_free(cell, Care::quick))
            return all;
        if (slopes_.ask(narrow || slopes_first)) {
            const auto tangent = slice_.tangent(cell);
            slopes_.helped(tangent.has_value());
            if (tangent) {
                slopes_told_ = !slice_.excludes_hit(tangent->value);
                return slopes_told_ ? by_slope(cell, tangent->slope) : all;
            }
        }
        if (slopes_first && is_free(cell, Care::quick))
            return all;
        if (cell.width() >= length_ * k_looked_at || !ways_.ask(narrow))
            return {};
        const bool free = is_free(cell, narrow ? Care::thorough : Care::close);
        ways_.helped(free);
        return free ? all : Look{};
    }

    bool is_free(const Interval& cell, Care care) { return slice_.excludes_hit(slice_.distance(cell, care)); }

    /// Applies the mean value theorem: the field falls at most as fast as the lowest slope, and at least as
    /// fast as the highest.
    Look by_slope(const Interval& cell, const Interval& slope) {
        const auto here = slice_.distance(place_at(cell.low), Care::thorough);
        if (!here || here->partial || !(here->low > 0))
            return {};
        if (slope.low >= 0)
            return {cell.width()};
        Look look{std::min(here->low / -slope.low * k_shorter, cell.width())};
        const double by = slope.high < 0 ? cell.low + here->high / -slope.high / k_shorter : k_infinity;
        if (by <= cell.high)
            look.hit_by = by;
        return look;
    }

    double next_width(const Interval& cell, const Look& look) const {
        const double width = cell.width();
        if (look.hit_by)
            return std::min(*look.hit_by - cell.low - look.free, width / 2);
        if (look.free >= width)
            return 2 * width;
        return look.free > narrowest(cell.low) ? std::clamp(2 * look.free, width / 8, width / 2) : width / 4;
    }

    /// Decides the hit at the start, for a march that does not leave it.
    FirstHit at_start() {
        const Interval start{last_, last_};
        const auto here = slice_.distance(place_at(last_), Care::thorough);
        if (slice_.is_hit(here))
            return answer(FirstHit::Verdict::hit, start, FirstHit::Reason::none);
        if (slice_.excludes_hit(here))
            return answer(FirstHit::Verdict::none, start, FirstHit::Reason::none);
        return answer(FirstHit::Verdict::undecided, start,
                      here->partial ? FirstHit::Reason::not_finite : FirstHit::Reason::grazing);
    }

    /// Decides a cell of the least width: looks for a place after it that is certainly below the threshold,
    /// else gives the reason why the cell is undecided.
    FirstHit at_narrow(const Interval& cell) {
        double reach = cell.width();
        for (int i = 0; i < k_doublings; ++i, reach *= 2) {
            const double end = std::min(cell.low + reach, last_);
            if (slice_.is_hit(slice_.distance(place_at(end), Care::thorough)))
                return answer(FirstHit::Verdict::hit, {cell.low, end}, FirstHit::Reason::none);
        }
        const auto all = slice_.distance(cell, Care::thorough);
        if (all && all->partial)
            return answer(FirstHit::Verdict::undecided, cell, FirstHit::Reason::not_finite);
        const bool wide = all && all->width() > k_jump * cell.width();
        return answer(FirstHit::Verdict::undecided, cell,
                      wide ? FirstHit::Reason::jump : FirstHit::Reason::grazing);
    }
    FirstHit answer(FirstHit::Verdict verdict, const Interval& where, FirstHit::Reason reason) const {
        return {verdict, reason, where, slice_.evaluations()};
    }

    MarchSlice& slice_;
    double last_;
    uint64_t most_;
    double relative_width_;
    double length_;
    double near_;
    bool slopes_told_ = false;
    Patience slopes_, ways_;
};

} // namespace

std::string_view to_string(FirstHit::Reason reason) {
    switch (reason) {
    case FirstHit::Reason::none: return "";
    case FirstHit::Reason::not_finite: return "NaN or an infinity cannot be excluded";
    case FirstHit::Reason::jump: return "the field jumps";
    case FirstHit::Reason::grazing: return "the ray grazes the surface";
    case FirstHit::Reason::budget: return "it took too many evaluations";
    }
    return "";
}

FirstHit first_hit(MarchSlice& slice, double last, uint64_t most_evaluations, double relative_width) {
    return HitSearch(slice, last, most_evaluations, relative_width).run();
}

namespace {

constexpr size_t k_first_pieces = 8;
/// The search ends once the safe and the unsafe multiple differ by less than this factor.
constexpr double k_close_enough = 1.05;
/// Share of the way to the hit: longer pieces have too many open paths for a closer evaluation.
constexpr double k_looked_at_closely = 1.0 / 64;
/// Factor by which each cut of the last piece moves its start nearer to the hit.
constexpr double k_nearer = 1.0 / 8;

/// A piece of the ray before the hit, and the multiple that is safe from all of its places.
struct Piece {
    double low, high;
    double safe;

    bool operator<(const Piece& other) const { return safe > other.safe; } // the least is on top
};

class StepSearch {
public:
    StepSearch(MarchSlice& slice, const Interval& hit, uint64_t most)
        : slice_(slice), hit_(hit), last_(slice.evaluations() + most), way_(hit.low - slice.start()) {}

    StepScale run() {
        for (size_t i = 0; i < k_first_pieces; ++i)
            look_at(slice_.start() + way_ * double(i) / k_first_pieces,
                    i + 1 == k_first_pieces ? hit_.low
                                            : slice_.start() + way_ * double(i + 1) / k_first_pieces);
        while (!pieces_.empty() && slice_.evaluations() < last_ && is_open(pieces_.top())) {
            const Piece worst = pieces_.top();
            pieces_.pop();
            const double middle = cut(worst);
            look_at(worst.low, middle);
            look_at(middle, worst.high);
        }
        found_.safe = pieces_.empty() ? k_longest_scale : std::min(pieces_.top().safe, k_longest_scale);
        return found_;
    }

private:
    bool is_open(const Piece& piece) const {
        return piece.safe < k_longest_scale && piece.safe * k_close_enough < found_.unsafe &&
               piece.high - piece.low > 1e-12 * std::abs(piece.high);
    }

    /// Returns the place that divides the piece geometrically, by its distance from the hit.
    double cut(const Piece& piece) const {
        const double far = hit_.low - piece.low, near = hit_.low - piece.high;
        return hit_.low - (near > 0 ? std::sqrt(far * near) : far * k_nearer);
    }

    void look_at(double low, double high) {
        sample(low);
        const Interval piece{low, high};
        const Care care = high - low < way_ * k_looked_at_closely ? Care::close : Care::quick;
        const auto found = slice_.distances(piece, care);
        if (!found)
            return;
        const Interval& above = found->above_threshold;
        if (above.partial || above.high > 0) // else the march stops here
            pieces_.push({low, high, std::max(by_bounds(piece, found->own), by_slope(piece))});
    }

    double by_bounds(const Interval& piece, const Interval& distance) const {
        return distance.partial || !(distance.high > 0) ? 0 : (hit_.low - piece.high) / distance.high;
    }

    /// Applies the mean value theorem: the distance is at most the slope times the way to its zero.
    double by_slope(const Interval& piece) {
        const auto tangent = slice_.tangent({piece.low, hit_.high});
        if (!tangent)
            return 0;
        return tangent->slope.low < 0 ? -1 / tangent->slope.low : k_infinity;
    }

    void sample(double at) {
        const auto found = slice_.distances(place_at(at), Care::close);
        if (!found || found->own.partial || !(found->above_threshold.low > 0) || !(found->own.low > 0))
            return;
        const double needed = (hit_.high - at) / found->own.low;
        if (needed < found_.unsafe) {
            found_.unsafe = needed;
            found_.at = at;
        }
    }

    MarchSlice& slice_;
    Interval hit_;
    uint64_t last_;
    double way_;
    StepScale found_;
    std::priority_queue<Piece> pieces_;
};

} // namespace

StepScale step_scale(MarchSlice& slice, const Interval& hit, uint64_t most_evaluations) {
    return StepSearch(slice, hit, most_evaluations).run();
}

namespace {

constexpr double k_widest_part = 1.0 / 16;
/// Within a piece the shortest step is at least this share of the longest. Evener pieces give a closer bound,
/// and there are more of them.
constexpr double k_evenness[] = {0.5, 0.8};
/// Or the piece is this share of its shortest step or less, so a step leaves it anyway.
constexpr double k_of_a_step = 0.25;
constexpr double k_narrowest = 1e-9;
/// Allowance for rounding in sums.
constexpr double k_step_shorter = 1 - 1e-12;

/// A piece of the ray, and bounds of the step from any of its places.
struct Stretch {
    double low, high;
    Interval step;

    double shortest() const { return step.low * k_step_shorter; }
};

class TurnCount {
public:
    TurnCount(MarchSlice& slice, double end, uint32_t enough, uint64_t most)
        : slice_(slice), end_(end), enough_(enough), last_(slice.evaluations() + most),
          length_(end - slice.start()) {}

    std::optional<uint32_t> run() {
        for (const double evenness : k_evenness)
            if (cover(evenness) && stops())
                if (const auto turns = turns_to_goal())
                    return turns;
        return std::nullopt;
    }

private:
    bool spent() const { return slice_.evaluations() >= last_; }

    std::optional<Interval> step(double low, double high) {
        const bool narrow = high - low < length_ * k_widest_part;
        return slice_.advance({low, high}, narrow ? Care::close : Care::quick);
    }

    /// Covers the ray with pieces from the start to the goal: the end, or the first place from which the loop
    /// is certainly left. `wall_` is how far beyond the goal the loop is left at every place.
    bool cover(double evenness) {
        pieces_.clear();
        goal_ = wall_ = end_;
        double at = slice_.start(), width = length_ * k_widest_part;
        while (at < end_) {
            const double high = std::min(at + width, end_);
            const auto found = step(at, high);
            if (!found) {
                goal_ = at;
                wall_ = high;
                return true;
            }
            const bool even = found->low >= evenness * found->high || high - at <= k_of_a_step * found->low;
            if (found->low > 0 && !found->partial && even) {
                pieces_.push_back({at, high, *found});
                at = high;
                width *= 2;
            } else {
                width /= 2;
                if (width < k_narrowest * std::max(1.0, std::abs(at)) || spent())
                    return false;
            }
        }
        return slice_.far().has_value();
    }

    /// Returns whether no step goes past the wall. Extends the wall first, then halves pieces whose steps
    /// seem to pass it.
    bool stops() {
        if (goal_ == end_)
            return true;
        double reach = 0;
        for (const Stretch& piece : pieces_)
            reach = std::max(reach, piece.high + piece.step.high);
        for (double width = wall_ - goal_; wall_ < std::min(reach, end_); width *= 2) {
            const double high = std::min(wall_ + width, end_);
            if (spent() || step(wall_, high))
                break;
            wall_ = high;
        }
        if (wall_ == end_ && slice_.far())
            return true;
        for (size_t i = 0; i < pieces_.size(); ++i)
            while (!(pieces_[i].high + pieces_[i].step.high < wall_))
                if (!halve(i))
                    return false;
        return true;
    }

    bool halve(size_t i) {
        const Stretch whole = pieces_[i];
        const double middle = whole.low + (whole.high - whole.low) / 2;
        if (spent() || whole.high - whole.low < k_narrowest * std::max(1.0, std::abs(whole.high)))
            return false;
        const auto left = step(whole.low, middle), right = step(middle, whole.high);
        // step for a half in which the loop is left anyway
        const Interval none{whole.step.low, whole.step.low};
        pieces_[i] = {whole.low, middle, left ? intersection(*left, whole.step) : none};
        pieces_.insert(pieces_.begin() + std::ptrdiff_t(i) + 1,
                       {middle, whole.high, right ? intersection(*right, whole.step) : none});
        return true;
    }

    /// Counts iterations by the least place that the slowest march has reached after each.
    std::optional<uint32_t> turns_to_goal() const {
        // least end of a step from this piece or a later one
        std::vector<double> least(pieces_.size() + 1, k_infinity);
        for (size_t i = pieces_.size(); i-- > 0;)
            least[i] = std::min(least[i + 1], pieces_[i].low + pieces_[i].shortest());
        double at = slice_.start();
        size_t here = 0;
        uint32_t turns = 0;
        while (at < goal_) {
            if (++turns > enough_)
                return std::nullopt;
            const double before = at;
            at = std::min(at + pieces_[here].shortest(), least[here + 1]);
            if (!(at > before))
                return std::nullopt;
            while (here + 1 < pieces_.size() && pieces_[here].high <= at)
                ++here;
        }
        return turns + 1; // plus the iteration that finds it
    }

    MarchSlice& slice_;
    double end_;
    uint32_t enough_;
    uint64_t last_;
    double length_;
    std::vector<Stretch> pieces_;
    double goal_ = 0, wall_ = 0;
};

} // namespace

std::optional<uint32_t> most_turns(MarchSlice& slice, double end, uint32_t enough,
                                   uint64_t most_evaluations) {
    if (!(end > slice.start()) || !std::isfinite(end - slice.start()))
        return std::nullopt;
    const auto turns = TurnCount(slice, end, enough, most_evaluations).run();
    return turns && *turns <= enough ? turns : std::nullopt;
}

} // namespace tidemark::proof
