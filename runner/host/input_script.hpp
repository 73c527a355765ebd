// Input of the user: its effect on a scene, and recordings of it.
//
// User input to a scene, converted to its uniforms: mouse, keyboard, orbit camera and knobs, from a window or
// from a recording.
#pragma once

#include "base/error.hpp"
#include "host/input_events.hpp"
#include "render/frame_state.hpp"
#include "scene/knob.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tidemark::host {

/// Resets the orbit camera to its initial position.
struct CameraReset {
    bool operator==(const CameraReset&) const = default;
};

/// Sets a knob to a value, as `--set` does.
struct KnobTurned {
    scene::KnobSetting setting;
    bool operator==(const KnobTurned&) const = default;
};

/// The pointer without a button, over a scene whose mouse follows it: texts of other hosts.
struct PointerFollowed {
    PointerPosition at;
    bool operator==(const PointerFollowed&) const = default;
};

/// Every event that a scene can react to.
using ControlEvent = std::variant<PointerMoved, ButtonPressed, ButtonReleased, WheelTurned, KeyPressed,
                                  KeyReleased, CameraReset, KnobTurned, PointerFollowed>;

class Controls {
public:
    explicit Controls(const render::OrbitCamera& camera) : initial_camera_(camera), camera_(camera) {}

    /// Applies an event; `height` is that of the drawn picture in pixels. Returns true if a uniform may have
    /// changed.
    bool handle(const ControlEvent& event, double height);

    /// Sets the mouse, the keys, the camera, and the knobs that were changed.
    void fill(render::FrameState& state) const;
    void place_camera(const render::OrbitCamera& camera) { camera_ = camera; }
    /// Takes mouse, camera and knobs from `state`, with all buttons released.
    void adopt(const render::FrameState& state);
    /// Scales the mouse position to a new picture size, so that it stays at the same relative place.
    void stretch(Extent from, Extent to);
    /// Drops held values that equal the scene's defaults, so that those knobs follow later changes of the
    /// defaults. Also drops values that a knob refuses since its type changed, and returns a message for
    /// each.
    std::vector<std::string> release(const std::vector<scene::Knob>& knobs);
    /// Call it after each drawn frame: clears what is set for one frame only, for example a new click or key
    /// press.
    void frame_drawn();

private:
    bool take(const PointerMoved& event);
    bool take(const ButtonPressed& event);
    bool take(const ButtonReleased& event);
    bool take(const WheelTurned& event);
    bool take(const KeyPressed& event);
    bool take(const KeyReleased& event);
    bool take(const CameraReset&);
    bool take(const KnobTurned& event);
    bool take(const PointerFollowed& event);

    render::OrbitCamera initial_camera_;
    render::OrbitCamera camera_;
    render::Mouse mouse_;
    render::Keyboard keyboard_;
    std::vector<scene::KnobSetting> knobs_; ///< held values, one per knob
    PointerPosition pointer_{};
    double height_ = 1;
    bool turning_ = false;
    bool panning_ = false;
    bool right_down_ = false;
};

// Mouse, keyboard and knob events by frame: parsed from text, replayed frame by frame, and recorded to text.

/// An event that happens before `frame` is drawn.
struct TimedEvent {
    int frame = 0;
    ControlEvent event;

    bool operator==(const TimedEvent&) const = default;
};

/// Events in ascending order of frames.
using InputScript = std::vector<TimedEvent>;

/// Parses one event a line; positions in pixels from the bottom left; a key is JavaScript's key code or a
/// name (`a`, `space`, `left`, `F1`); `#` begins a comment:
///
///     FRAME press left|middle|right X Y       FRAME move X Y       FRAME keydown KEY
///     FRAME release left|middle|right         FRAME wheel UP       FRAME keyup KEY
///     FRAME camera reset                      FRAME set NAME=VALUE
///     FRAME point X Y                         (without a button, for scenes whose mouse follows the pointer)
///
/// Errors (ErrorCode::load) have their place in `file`.
Result<InputScript> parse_input_script(std::string_view text, const std::string& file);
Result<InputScript> load_input_script(const std::filesystem::path& file);

/// Returns true if the script sets a knob.
bool turns_knobs(const InputScript& script);

/// Fails (ErrorCode::usage) if the scene lacks a knob of the script, or the knob does not accept the value.
Result<void> check_knobs(const InputScript& script, std::vector<scene::Knob> knobs);

/// Returns the text that parses to this script.
std::string to_string(const InputScript& script);

/// Returns the state with recorded input removed: mouse, keys and knobs are reset and the camera is the
/// initial one.
render::FrameState without_recorded(render::FrameState state);

/// Plays a script, which may still be recorded. Frames may be requested in any order.
class Replay {
public:
    Replay(InputScript script, const render::OrbitCamera& camera)
        : script_(std::move(script)), camera_(camera), controls_(camera) {}

    /// Sets mouse, keyboard, camera and knobs as they are after all events up to the state's frame.
    void fill(render::FrameState& state);

    /// Adds an event before `frame`, after `go_back(frame)`.
    void note(int frame, const ControlEvent& event);
    /// Removes the events after `frame`, which is the next one to be filled.
    void go_back(int frame);
    const InputScript& script() const { return script_; }

private:
    InputScript script_;
    render::OrbitCamera camera_;
    Controls controls_;
    size_t next_ = 0; ///< index of the next event
    int frame_ = 0;   ///< the frame that the controls are ready for
};

} // namespace tidemark::host
