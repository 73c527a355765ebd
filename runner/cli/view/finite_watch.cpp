#include "cli/view/finite_watch.hpp"

#include "cli/not_finite.hpp"
#include "cli/view/wall_clock.hpp"

#include <algorithm>
#include <limits>

namespace tidemark::cli {
namespace {

constexpr double k_shortest_pause_seconds = 1;
/// Limits the checks to 1 % of the time.
constexpr double k_pause_per_second_of_looking = 100;

} // namespace

void FiniteWatch::begin_anew() {
    *this = {};
}

double FiniteWatch::due() const {
    return unseen_ && found_ == 0 ? next_ : std::numeric_limits<double>::infinity();
}

size_t FiniteWatch::look(const render::Renderer& renderer, double now) {
    image::Image picture = renderer.read_back();
    found_ = count_not_finite(renderer, picture);
    unseen_ = false;
    next_ = now + std::max(k_shortest_pause_seconds, k_pause_per_second_of_looking * (now_seconds() - now));
    return found_;
}

} // namespace tidemark::cli
