// Mouse, keyboard and knob events by frame: read from a text, replayed frame by frame, recorded into a text.
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

/// Happens before `frame` is drawn.
struct TimedEvent {
    int frame = 0;
    ControlEvent event;

    bool operator==(const TimedEvent&) const = default;
};

/// In the order of their frames.
using InputScript = std::vector<TimedEvent>;

/// One event a line; pixels from the bottom left, JavaScript's key codes; `#` begins a comment:
///
///     FRAME press left|middle|right X Y       FRAME move X Y       FRAME keydown CODE
///     FRAME release left|middle|right         FRAME wheel UP       FRAME keyup CODE
///     FRAME camera reset                      FRAME set NAME=VALUE
///
/// Errors (ErrorCode::load) have their place in `file`.
Result<InputScript> parse_input_script(std::string_view text, const std::string& file);
Result<InputScript> load_input_script(const std::filesystem::path& file);

/// Whether a knob is turned in it.
bool turns_knobs(const InputScript& script);

/// Fails (ErrorCode::usage) where the scene has no such knob, or one that does not take the value.
Result<void> check_knobs(const InputScript& script, std::vector<scene::Knob> knobs);

/// The text that parses to that script.
std::string to_string(const InputScript& script);

/// The state as it was before a recording's events came to it.
render::FrameState without_recorded(render::FrameState state);

/// A script under way, which may still be written. The frames that are asked for may be any, in any order.
class Replay {
public:
    Replay(InputScript script, const render::OrbitCamera& camera)
        : script_(std::move(script)), camera_(camera), controls_(camera) {}

    /// Sets what the events up to the state's frame make of mouse, keyboard, camera and knobs.
    void fill(render::FrameState& state);

    /// Adds what happens before `frame`, after `go_back` to it.
    void note(int frame, const ControlEvent& event);
    /// Forgets what comes after `frame`, which is the next to be filled.
    void go_back(int frame);
    const InputScript& script() const { return script_; }

private:
    InputScript script_;
    render::OrbitCamera camera_;
    Controls controls_;
    size_t next_ = 0; ///< event
    int frame_ = 0;   ///< that the controls are ready for
};

} // namespace tidemark::cli
