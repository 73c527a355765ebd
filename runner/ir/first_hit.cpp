#include "ir/first_hit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tidemark::ir {
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
        double free = 0; ///< length from the cell's low end that has no hit
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

} // namespace tidemark::ir
