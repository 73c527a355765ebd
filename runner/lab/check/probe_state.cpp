#include "lab/check/probe_state.hpp"

#include "base/try.hpp"
#include "scene/overrides.hpp"

#include <algorithm>

namespace tidemark::lab {

FrameState state_at(double seconds, Extent extent) {
    return render::at_time(seconds, {.extent = extent});
}

FrameState plain_state(Extent extent) {
    return state_at(1, extent);
}

std::vector<FrameState> usual_moments() {
    std::vector<FrameState> states;
    for (const double time :
         {0.0, 1e-6, 1.0, 60.0, 62.83 - 1 / 60.0, 62.83 + 1 / 60.0, 1e3, 1e4, 1e5, 1e6, 16777216.0, -5.0})
        states.push_back(state_at(time));
    return states;
}

FrameState with_mouse(render::Mouse mouse, FrameState state) {
    state.mouse = mouse;
    return state;
}

int first_frame_of(const FrameState& state) {
    constexpr int k_run_up = 8;
    return state.time ? std::max(state.frame - k_run_up, 0) : 0;
}

Result<scene::Scene> in_state(scene::Scene scene, const FrameState& state) {
    for (const std::string& channel : state.channels)
        TRY(scene::override_channel(scene, channel));
    auto turned = with(std::move(scene), state.knobs);
    return turned ? with(*std::move(turned), state.definitions) : turned;
}

} // namespace tidemark::lab
