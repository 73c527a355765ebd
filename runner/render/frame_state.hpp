// One moment of a scene: all that decides what a frame shows, beside the scene's own files. The values of
// ShaderToy's uniforms are made of it in one place; whoever draws a frame, a window, a recording or a probe,
// says it with this value. A new field goes into render/frame_fields.hpp, too.
#pragma once

#include "base/extent.hpp"
#include "render/frame_inputs.hpp"
#include "render/keyboard.hpp"
#include "render/mouse.hpp"
#include "render/orbit_camera.hpp"
#include "scene/setting.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::render {

struct FrameState {
    int frame = 0;                ///< iFrame
    std::optional<double> time{}; ///< iTime, seconds; none: frame / fps
    Extent extent{640, 360};
    double fps = 60;                             ///< iFrameRate
    std::optional<double> time_delta{};          ///< iTimeDelta, seconds; none: 1 / fps
    Mouse mouse{};                               ///< iMouse, and the left one of iMouseButton
    bool right_button = false;                   ///< the right one: down
    KeyboardTexels keys{};                       ///< of the keyboard's texture
    Date date{};                                 ///< iDate at iTime 0
    OrbitCamera camera{};                        ///< iCamera
    std::optional<OrbitCamera> initial_camera{}; ///< where it stood at first, for iViewMatrix; none: here
    std::vector<scene::Setting> knobs{};         ///< set to something else than in the scene
    std::vector<scene::Setting> definitions{};   ///< of `#define NAME` and `const … NAME`, likewise
    std::vector<std::string> channels{};         ///< `0=none`, as --channel has them
    std::string pass{};                          ///< that is shown; empty: Image

    bool operator==(const FrameState&) const = default;

    /// iTime.
    double seconds() const { return time.value_or(double(frame) / fps); }
    /// Whether the mouse and the camera are moved by one hand, as in a window: the mouse is then no place
    /// that an option of its own says.
    bool moves_camera() const { return camera != OrbitCamera{} || (initial_camera && mouse != Mouse{}); }
    /// Another frame of the same run: its time is as far from this one's as the frames are apart.
    FrameState at_frame(int number) const;
    /// Whether the other is a frame of this run, but for roundings of its time.
    bool is_in_run_of(const FrameState& other) const;
};

/// The state at a time, in the frame that the time falls in; before the start that is frame 0.
FrameState at_time(double seconds, FrameState state = {});

/// The uniforms' values.
FrameInputs inputs_of(const FrameState& state);

/// What each frame of a run sees.
using FrameStates = std::function<FrameState(int frame)>;

} // namespace tidemark::render
