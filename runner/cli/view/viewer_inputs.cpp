// Live inputs: messages, carried out like commands of the overlay so that they are recorded, too; and sound.
#include "base/try.hpp"
#include "cli/view/viewer.hpp"

#include <variant>

namespace tidemark::cli {

Result<void> Viewer::open_inputs() {
    if (settings_.inputs && recording())
        say_what_is_not_recorded(*settings_.inputs);
    if (settings_.inputs)
        inputs_ = TRY(LiveInputs::open(*settings_.inputs, [&on = *screen_] { on.wake(); }));
    return {};
}

void Viewer::take_inputs() {
    if (!inputs_ || !stage_ || !inputs_->any())
        return;
    for (const live::Command& command : inputs_->take(turned_knobs(), controllers_))
        std::visit([this](const auto& wanted) { carry_out(wanted); }, command);
}

/// Returns the inputs of the frame to draw now, with fresh sound and webcam data.
render::FrameInputs Viewer::heard_inputs(const render::FrameState& state) {
    if (inputs_)
        inputs_->hear();
    return inputs_at(state);
}

/// Returns the inputs of a frame, with the last sound and webcam data.
render::FrameInputs Viewer::inputs_at(const render::FrameState& state) const {
    render::FrameInputs inputs = inputs_of(state);
    if (inputs_)
        inputs.live = inputs_->media();
    return inputs;
}

render::FrameInputs Viewer::inputs_on_show() const {
    return inputs_at(shown_);
}

/// Returns the knobs with their latest values, which may not be in a frame yet.
std::vector<scene::Knob> Viewer::turned_knobs() const {
    render::FrameState state;
    controls_.fill(state);
    std::vector<scene::Knob> knobs = stage_->renderer().scene().knobs;
    for (scene::Knob& knob : knobs)
        knob.value = value_after(knob, state.knobs);
    return knobs;
}

void Viewer::carry_out(const live::SetPlaying& command) {
    if (command.on == clock_.paused())
        carry_out(live::TogglePause{});
}

void Viewer::carry_out(const live::LearnController& command) {
    controllers_.learn({command.knob, command.component});
    stale_overlay_ = true;
}

void Viewer::carry_out(const live::ForgetController& command) {
    controllers_.forget({command.knob, command.component});
    stale_overlay_ = true;
}

} // namespace tidemark::cli
