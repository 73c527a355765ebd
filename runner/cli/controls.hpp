// What people do to a scene, as its uniforms show it: mouse, keyboard and orbit camera, whether the events
// come from a window or from a recording.
#pragma once

#include "platform/input.hpp"
#include "render/frame_state.hpp"

#include <variant>

namespace tidemark::cli {

/// The orbit camera goes back to where it stood at first.
struct CameraReset {
    bool operator==(const CameraReset&) const = default;
};

/// What a scene may learn of.
using ControlEvent =
    std::variant<platform::PointerMoved, platform::ButtonPressed, platform::ButtonReleased,
                 platform::WheelTurned, platform::KeyPressed, platform::KeyReleased, CameraReset>;

class Controls {
public:
    explicit Controls(const render::OrbitCamera& camera) : initial_camera_(camera), camera_(camera) {}

    /// `height` in pixels of what is drawn. True when a uniform may have changed.
    bool handle(const ControlEvent& event, double height);

    /// Sets the mouse, the keys and the camera.
    void fill(render::FrameState& state) const;
    /// To be called when a frame has been drawn: what was new in it is then no longer new.
    void frame_drawn();

private:
    bool take(const platform::PointerMoved& event);
    bool take(const platform::ButtonPressed& event);
    bool take(const platform::ButtonReleased& event);
    bool take(const platform::WheelTurned& event);
    bool take(const platform::KeyPressed& event);
    bool take(const platform::KeyReleased& event);
    bool take(const CameraReset&);

    render::OrbitCamera initial_camera_;
    render::OrbitCamera camera_;
    render::Mouse mouse_;
    render::Keyboard keyboard_;
    platform::PointerPosition pointer_{};
    double height_ = 1;
    bool turning_ = false;
    bool panning_ = false;
    bool right_down_ = false;
};

} // namespace tidemark::cli
