#include "lab/check/horizon.hpp"

#include "base/try.hpp"
#include "lab/check/picture_gap.hpp"

namespace tidemark::lab {
namespace {

/// A third of a second.
constexpr double k_third = 1.0 / 3;

} // namespace

Result<Horizon> find_horizon(ProbeBench& bench) {
    Horizon horizon;
    for (const double time : {1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6}) {
        const FrameState state = state_at(time + k_third);
        auto as_is = TRY(bench.picture(state));
        const auto truth = TRY(bench.picture(state, glsl::Precision::promoted));
        const double difference = p99_difference(as_is, truth);
        if (difference > k_visible_gap) {
            horizon.mismatch = Mismatch{time, state, std::move(as_is), difference};
            break;
        }
        horizon.good = time;
    }
    return horizon;
}

} // namespace tidemark::lab
