// One moment of a scene: all that determines a frame apart from the scene's files. Windows, recordings and
// probes describe a frame by this value, and `inputs_of` computes ShaderToy's uniforms from it. A new field
// must also be added to `k_frame_fields`.
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
    Mouse mouse{};                               ///< iMouse, and the left button of iMouseButton
    bool right_button = false;                   ///< down; of iMouseButton
    KeyboardTexels keys{};                       ///< texels of the keyboard texture
    Date date{};                                 ///< iDate at iTime 0
    OrbitCamera camera{};                        ///< iCamera
    std::optional<OrbitCamera> initial_camera{}; ///< first position, for iViewMatrix; none: `camera`
    std::vector<scene::Setting> knobs{};         ///< values that differ from the scene's
    /// Values of `#define NAME` and `const … NAME` that differ from the scene's.
    std::vector<scene::Setting> definitions{};
    std::vector<std::string> channels{};         ///< in the form of --channel: `0=none`
    std::string pass{};                          ///< pass to show; empty: Image

    bool operator==(const FrameState&) const = default;

    /// Returns iTime.
    double seconds() const { return time.value_or(double(frame) / fps); }
    /// Returns whether the mouse moves the camera, as in a window. If so, the mouse position was not set by
    /// an option of its own.
    bool moves_camera() const { return camera != OrbitCamera{} || (initial_camera && mouse != Mouse{}); }
    /// Returns another frame of the same run; its time differs by the number of frames between them.
    FrameState at_frame(int number) const;
    /// Returns whether `other` is a frame of the same run, apart from rounding of its time.
    bool is_in_run_of(const FrameState& other) const;
};

/// Returns the state at a time, in the frame that contains it; times before 0 are in frame 0.
FrameState at_time(double seconds, FrameState state = {});

/// Computes the uniforms' values.
FrameInputs inputs_of(const FrameState& state);

/// Returns the state of each frame of a run.
using FrameStates = std::function<FrameState(int frame)>;

} // namespace tidemark::render
