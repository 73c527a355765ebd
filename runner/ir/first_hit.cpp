#include "ir/first_hit.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::ir {
namespace {

/// Of a hit, relative to the parameter and to the length of the ray.
constexpr double k_relative_width = 4e-6;
constexpr double k_first_part = 1.0 / 16;
/// Of the ray's length: near the start a hit is not narrowed down further than by k_relative_width of that,
/// or of the distance there if it is less.
constexpr double k_near_part = 1e-2;
/// How far behind a place that may be one a hit is looked for: so often the width is doubled.
constexpr int k_doublings = 10;
/// Wider than a slope makes it.
constexpr double k_jump = 1e3;

class Search {
public:
    Search(MarchSlice& slice, double last, uint64_t most)
        : slice_(slice), last_(last), most_(most), length_(last - slice.start()), near_(near()) {}

    FirstHit run() {
        double at = slice_.start();
        double width = length_ * k_first_part;
        while (at < last_) {
            const Interval cell{at, std::min(at + width, last_)};
            if (slice_.evaluations() >= most_)
                return answer(FirstHit::Verdict::undecided, cell, FirstHit::Reason::budget);
            if (is_free(cell)) {
                at = cell.high;
                width *= 2;
            } else if (cell.width() > narrowest(at)) {
                width = cell.width() / 2;
            } else {
                return at_narrow(cell);
            }
        }
        return answer(FirstHit::Verdict::none, {slice_.start(), last_}, FirstHit::Reason::none);
    }

private:
    double near() {
        const auto distance = slice_.distance({slice_.start(), slice_.start()}, false);
        const bool known = distance && distance->low > 0;
        return std::min(k_near_part * length_, known ? distance->low : k_infinity);
    }
    double narrowest(double at) const { return k_relative_width * std::max(std::abs(at), near_); }

    /// A closer look costs a run for each way: it is taken where the first one leaves it open.
    bool is_free(const Interval& cell) {
        const auto quick = slice_.distance(cell, false);
        if (slice_.excludes_hit(quick))
            return true;
        return cell.width() < length_ * k_first_part && slice_.excludes_hit(slice_.distance(cell, true));
    }

    /// Somewhere from here on it is surely below the threshold, or that is not known.
    FirstHit at_narrow(const Interval& cell) {
        double reach = cell.width();
        for (int i = 0; i < k_doublings; ++i, reach *= 2) {
            const double end = std::min(cell.low + reach, last_);
            if (slice_.is_hit(slice_.distance({end, std::nextafter(end, k_infinity)}, true)))
                return answer(FirstHit::Verdict::hit, {cell.low, end}, FirstHit::Reason::none);
        }
        const auto all = slice_.distance(cell, true);
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
    double length_;
    double near_;
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

FirstHit first_hit(MarchSlice& slice, double last, uint64_t most_evaluations) {
    return Search(slice, last, most_evaluations).run();
}

} // namespace tidemark::ir
