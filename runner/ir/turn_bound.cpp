#include "ir/turn_bound.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tidemark::ir {
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

} // namespace tidemark::ir
