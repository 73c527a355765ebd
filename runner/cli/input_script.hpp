// Mouse, keyboard and knob events by frame: parsed from text, replayed frame by frame, and recorded to text.
#pragma once

#include "base/result.hpp"
#include "cli/controls.hpp"
#include "platform/input.hpp"
#include "scene/knob.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

/// An event that happens before `frame` is drawn.
struct TimedEvent {
    int frame = 0;
    ControlEvent event;

    bool operator==(const TimedEvent&) const = default;
};

/// Events in ascending order of frames.
using InputScript = std::vector<TimedEvent>;

/// Parses one event a line; positions in pixels from the bottom left, JavaScript's key codes; `#` begins a
/// comment:
///
///     FRAME press left|middle|right X Y       FRAME move X Y       FRAME keydown CODE
///     FRAME release left|middle|right         FRAME wheel UP       FRAME keyup CODE
///     FRAME camera reset                      FRAME set NAME=VALUE
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

} // namespace tidemark::cli
