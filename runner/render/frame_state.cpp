#include "render/frame_state.hpp"

#include <glm/matrix.hpp>

#include <cmath>

namespace tidemark::render {

FrameState FrameState::at_frame(int number) const {
    FrameState other = *this;
    other.frame = number;
    if (time)
        other.time = *time - (frame - number) / fps;
    return other;
}

bool FrameState::is_in_run_of(const FrameState& other) const {
    FrameState here = other.at_frame(frame);
    const double gap = std::abs(here.seconds() - seconds());
    here.time = time;
    return here == *this && gap < 1e-6 / fps;
}

FrameState at_time(double seconds, FrameState state) {
    state.time = seconds;
    state.frame = frame_at(seconds, state.fps);
    return state;
}

FrameInputs inputs_of(const FrameState& state) {
    FrameInputs inputs;
    inputs.frame = state.frame;
    inputs.time = state.seconds();
    inputs.time_delta = state.time_delta.value_or(1 / state.fps);
    inputs.frame_rate = state.fps;
    inputs.mouse = state.mouse.uniform();
    inputs.mouse_button = {state.mouse.down ? 1 : 0, state.right_button ? 1 : 0};
    inputs.keyboard = state.keys;
    inputs.date = later(state.date, inputs.time);
    inputs.camera = state.camera.matrix();
    const OrbitMotion motion = motion_of(state.camera);
    inputs.orbit = {motion.turn, motion.distance, state.moves_camera() ? 1 : 0};
    inputs.orbit_pan = motion.pan;
    inputs.knobs = state.knobs;
    if (state.initial_camera)
        inputs.view = inverse(state.initial_camera->matrix()) * inputs.camera;
    return inputs;
}

} // namespace tidemark::render
