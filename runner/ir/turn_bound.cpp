#include "ir/turn_bound.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tidemark::ir {
namespace {

constexpr double k_widest_part = 1.0 / 16;
/// Within a piece the shortest step is at least such a part of the longest. Closer pieces bound the turns
/// closer, and are more.
constexpr double k_evenness[] = {0.5, 0.8};
/// Or the piece is so short that a step leaves it anyway.
constexpr double k_of_a_step = 0.25;
constexpr double k_narrowest = 1e-9;
/// For the roundings of sums.
constexpr double k_step_shorter = 1 - 1e-12;

/// A piece of the ray, and how far a step from any of its places goes, at least and at most.
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

    /// Stretchs from the start to the end, or to where the loop is surely left: that is the goal. Beyond it,
    /// as far as the loop is left all along, `wall_`.
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

    /// Whether no step goes past the wall. It is looked how far the wall goes, and pieces whose steps seem to
    /// go past are looked at in halves.
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
        const Interval none{whole.step.low, whole.step.low}; // where the loop is left anyway
        pieces_[i] = {whole.low, middle, left ? intersection(*left, whole.step) : none};
        pieces_.insert(pieces_.begin() + std::ptrdiff_t(i) + 1,
                       {middle, whole.high, right ? intersection(*right, whole.step) : none});
        return true;
    }

    /// Turn after turn, how far the slowest march has come at least.
    std::optional<uint32_t> turns_to_goal() const {
        std::vector<double> least(pieces_.size() + 1, k_infinity); // of where steps from there and beyond end
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
        return turns + 1; // the one that finds it
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
