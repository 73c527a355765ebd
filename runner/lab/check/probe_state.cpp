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
