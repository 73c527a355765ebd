#include "lab/march/area_slopes.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

constexpr Extent k_areas{16, 9};
/// Length of the pieces: the first is this share of the ray's length, the others are this share of the way so
/// far. They grow with the area's width.
constexpr double k_first_piece = 1.0 / 128;
constexpr double k_longer = 0.1;
/// A piece without a bound is cut into this many.
constexpr int k_cuts = 4;
/// Steeper bounds do not limit steps.
constexpr double k_steepest = 100;

class AreaLook {
public:
    AreaLook(ir::MarchSlice& slice, double end, AreaSlopes& slopes)
        : slice_(slice), end_(end), unit_(slice.unit()), slopes_(slopes) {}

    void run() {
        const double start = slice_.start(), first = (end_ - start) * k_first_piece;
        for (double at = start; at < end_;) {
            const double high = std::min(at + std::max(first, k_longer * (at - start)), end_);
            if (!look_at({at, high}, k_cuts))
                return;
            at = high;
        }
    }

private:
    /// Adds the bounds of a piece. Returns whether the space before the surface continues after it.
    bool look_at(const ir::Interval& piece, int cuts) {
        const auto tangent = slice_.tangent(piece);
        if (tangent && !(tangent->value.high > 0))
            return false;
        const auto beside = tangent ? std::optional(tangent->slope) : slice_.slope_beside_jumps(piece);
        if (beside && -beside->low <= k_steepest * unit_) {
            const double way = piece.width() * unit_;
            slopes_.bounded.push_back({std::max(0.0, -beside->low / unit_), way});
            slopes_.may_jump += tangent ? 0 : way;
            return true;
        }
        if (cuts == 1) {
            const auto distance = slice_.distance(piece, ir::Care::quick);
            if (distance && !distance->partial && !(distance->high > 0))
                return false;
            (distance && distance->partial ? slopes_.not_finite : slopes_.unbounded) += piece.width() * unit_;
            return true;
        }
        bool more = true;
        for (int i = 0; i < cuts && more; ++i)
            more = look_at({piece.low + piece.width() * i / cuts, piece.low + piece.width() * (i + 1) / cuts},
                           1);
        return more;
    }

    ir::MarchSlice& slice_;
    double end_;
    double unit_;
    AreaSlopes& slopes_;
};

} // namespace

double AreaSlopes::bounded_way() const {
    double sum = 0;
    for (const Bound& each : bounded)
        sum += each.way;
    return sum;
}

double AreaSlopes::falls_on(double part) const {
    std::vector<Bound> sorted = bounded;
    std::ranges::sort(sorted, {}, &Bound::falls);
    double left = part * bounded_way();
    for (const Bound& each : sorted)
        if ((left -= each.way) <= 0)
            return each.falls;
    return sorted.empty() ? 0 : sorted.back().falls;
}

void AreaSlopes::add(const AreaSlopes& more) {
    bounded.insert(bounded.end(), more.bounded.begin(), more.bounded.end());
    may_jump += more.may_jump;
    unbounded += more.unbounded;
    not_finite += more.not_finite;
}

AreaSlopes area_slopes(const MarchRays& rays, uint64_t most_evaluations) {
    AreaSlopes slopes;
    const Extent whole = rays.extent();
    const double width = double(whole.width) / k_areas.width, height = double(whole.height) / k_areas.height;
    uint64_t left = most_evaluations;
    for (int y = 0; y < k_areas.height; ++y)
        for (int x = 0; x < k_areas.width; ++x) {
            const auto one = rays.enter({int((x + 0.5) * width), int((y + 0.5) * height)}, ir::Surface::zero);
            if (!one || !one->slice || one->march.turns.empty() || left == 0)
                continue;
            auto all = rays.enter_all({{x * width, (x + 1) * width}, {y * height, (y + 1) * height}},
                                      ir::SliceOf::distance, ir::Surface::zero);
            const double end = one->slice->end(one->march);
            const double way = (end - one->slice->start()) * one->slice->unit();
            if (!std::isfinite(way) || !(way > 0))
                continue;
            if (!all || all->loop != one->loop) { // the code before the march may differ
                slopes.unbounded += way;
                continue;
            }
            AreaLook(all->slice, end, slopes).run();
            left -= std::min(left, all->slice.evaluations());
        }
    return slopes;
}

} // namespace tidemark::lab
