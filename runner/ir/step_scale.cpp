#include "ir/step_scale.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

namespace tidemark::ir {
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

} // namespace tidemark::ir
