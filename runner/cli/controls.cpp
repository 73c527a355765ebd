#include "cli/controls.hpp"

namespace tidemark::cli {

using platform::Button;

bool Controls::handle(const ControlEvent& event, double height) {
    height_ = height;
    return std::visit([this](const auto& happened) { return take(happened); }, event);
}

bool Controls::take(const platform::PointerMoved& event) {
    const double dx = event.at.x - pointer_.x;
    const double dy = event.at.y - pointer_.y;
    pointer_ = event.at;
    if (turning_) {
        mouse_.move(event.at.x, event.at.y);
        camera_.turn(dx, dy, height_);
    }
    if (panning_)
        camera_.pan(dx, dy, height_);
    return turning_ || panning_;
}

bool Controls::take(const platform::ButtonPressed& event) {
    pointer_ = event.at;
    if (event.button == Button::left) {
        turning_ = true;
        mouse_.press(event.at.x, event.at.y);
    } else if (event.button == Button::middle) {
        panning_ = true;
    } else {
        right_down_ = true;
    }
    return true;
}

bool Controls::take(const platform::ButtonReleased& event) {
    if (event.button == Button::left) {
        turning_ = false;
        mouse_.release();
    } else if (event.button == Button::middle) {
        panning_ = false;
    } else {
        right_down_ = false;
    }
    return true;
}

bool Controls::take(const platform::WheelTurned& event) {
    camera_.zoom(event.up);
    return true;
}

bool Controls::take(const platform::KeyPressed& event) {
    keyboard_.press(platform::js_key_code(event.key));
    return true;
}

bool Controls::take(const platform::KeyReleased& event) {
    keyboard_.release(platform::js_key_code(event.key));
    return true;
}

bool Controls::take(const CameraReset&) {
    camera_ = initial_camera_;
    return true;
}

bool Controls::take(const KnobTurned& event) {
    scene::set(knobs_, event.setting);
    return true;
}

void Controls::release(const std::vector<scene::Knob>& knobs) {
    for (const scene::Knob& knob : knobs)
        if (knob.value == knob.initial && value_after(knob, knobs_) == knob.initial)
            std::erase_if(knobs_, [&](const scene::Setting& held) { return held.name == knob.name; });
}

void Controls::adopt(const render::FrameState& state) {
    mouse_ = state.mouse;
    mouse_.release();
    mouse_.frame_drawn();
    camera_ = state.camera;
    knobs_ = state.knobs;
}

void Controls::stretch(Extent from, Extent to) {
    mouse_.stretch(from, to);
    pointer_.x *= double(to.width) / from.width;
    pointer_.y *= double(to.height) / from.height;
}

void Controls::fill(render::FrameState& state) const {
    state.mouse = mouse_;
    state.right_button = right_down_;
    state.keys = keyboard_.texels();
    state.camera = camera_;
    state.initial_camera = initial_camera_;
    for (const scene::Setting& setting : knobs_)
        scene::set(state.knobs, setting);
}

void Controls::frame_drawn() {
    mouse_.frame_drawn();
    keyboard_.frame_drawn();
}

} // namespace tidemark::cli
