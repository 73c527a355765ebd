// What people do to a scene, as its uniforms show it: mouse, keyboard, orbit camera and knobs, whether the
// events come from a window or from a recording.
#pragma once

#include "platform/input.hpp"
#include "render/frame_state.hpp"
#include "scene/knob.hpp"

#include <variant>
#include <vector>

namespace tidemark::cli {

/// The orbit camera goes back to where it stood at first.
struct CameraReset {
    bool operator==(const CameraReset&) const = default;
};

/// A knob is set to a value, as `--set` has it.
struct KnobTurned {
    scene::Setting setting;
    bool operator==(const KnobTurned&) const = default;
};

/// What a scene may learn of.
using ControlEvent =
    std::variant<platform::PointerMoved, platform::ButtonPressed, platform::ButtonReleased,
                 platform::WheelTurned, platform::KeyPressed, platform::KeyReleased, CameraReset, KnobTurned>;

class Controls {
public:
    explicit Controls(const render::OrbitCamera& camera) : initial_camera_(camera), camera_(camera) {}

    /// `height` in pixels of what is drawn. True when a uniform may have changed.
    bool handle(const ControlEvent& event, double height);

    /// Sets the mouse, the keys, the camera, and the knobs that were turned.
    void fill(render::FrameState& state) const;
    /// Mouse, camera and knobs are that state's from now on; no button is down.
    void adopt(const render::FrameState& state);
    /// The picture has another size from now on: the mouse stays at its place of it.
    void stretch(Extent from, Extent to);
    /// Knobs that stand where the scene has them are not held there: they follow its defaults.
    void release(const std::vector<scene::Knob>& knobs);
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
    bool take(const KnobTurned& event);

    render::OrbitCamera initial_camera_;
    render::OrbitCamera camera_;
    render::Mouse mouse_;
    render::Keyboard keyboard_;
    std::vector<scene::Setting> knobs_; ///< each once
    platform::PointerPosition pointer_{};
    double height_ = 1;
    bool turning_ = false;
    bool panning_ = false;
    bool right_down_ = false;
};

} // namespace tidemark::cli
