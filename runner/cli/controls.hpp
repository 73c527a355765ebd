// User input to a scene, converted to its uniforms: mouse, keyboard, orbit camera and knobs, from a window or
// from a recording.
#pragma once

#include "platform/input.hpp"
#include "render/frame_state.hpp"
#include "scene/knob.hpp"

#include <variant>
#include <vector>

namespace tidemark::cli {

/// Resets the orbit camera to its initial position.
struct CameraReset {
    bool operator==(const CameraReset&) const = default;
};

/// Sets a knob to a value, as `--set` does.
struct KnobTurned {
    scene::Setting setting;
    bool operator==(const KnobTurned&) const = default;
};

/// Every event that a scene can react to.
using ControlEvent =
    std::variant<platform::PointerMoved, platform::ButtonPressed, platform::ButtonReleased,
                 platform::WheelTurned, platform::KeyPressed, platform::KeyReleased, CameraReset, KnobTurned>;

class Controls {
public:
    explicit Controls(const render::OrbitCamera& camera) : initial_camera_(camera), camera_(camera) {}

    /// Applies an event; `height` is that of the drawn picture in pixels. Returns true if a uniform may have
    /// changed.
    bool handle(const ControlEvent& event, double height);

    /// Sets the mouse, the keys, the camera, and the knobs that were changed.
    void fill(render::FrameState& state) const;
    /// Takes mouse, camera and knobs from `state`, with all buttons released.
    void adopt(const render::FrameState& state);
    /// Scales the mouse position to a new picture size, so that it stays at the same relative place.
    void stretch(Extent from, Extent to);
    /// Drops held values that equal the scene's defaults, so that those knobs follow later changes of the
    /// defaults.
    void release(const std::vector<scene::Knob>& knobs);
    /// Call it after each drawn frame: clears what is set for one frame only, for example a new click or key
    /// press.
    void frame_drawn();

private:
    bool take(const platform::PointerMoved& event);
    bool take(const platform::ButtonPressed& event);
    bool take(const platform::ButtonReleased& event);
    bool take(const platform::WheelTurned& event);
    bool take(const platform::KeyPressed& event);
    bool take(const platform::KeyReleased& event);
    bool take(const CameraReset&);
    bool take(const KnobTurned& event);

    render::OrbitCamera initial_camera_;
    render::OrbitCamera camera_;
    render::Mouse mouse_;
    render::Keyboard keyboard_;
    std::vector<scene::Setting> knobs_; ///< held values, one per knob
    platform::PointerPosition pointer_{};
    double height_ = 1;
    bool turning_ = false;
    bool panning_ = false;
    bool right_down_ = false;
};

} // namespace tidemark::cli
