// One state in which a scene is looked at: a moment, a size, a mouse and what is set otherwise, with the
// options that bring it back.
#pragma once

#include "base/extent.hpp"
#include "lab/setting.hpp"
#include "render/frame_inputs.hpp"
#include "render/orbit_camera.hpp"
#include "scene/scene.hpp"

#include <glm/vec2.hpp>

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

struct Situation {
    Extent extent{64, 36};
    double time = 1;                          ///< iTime, seconds
    std::optional<int> stepped{};             ///< in place of `time`: this frame, and before it all from 0 on
    std::optional<glm::ivec2> mouse{};        ///< the pixel that was clicked; none: never touched
    std::optional<glm::ivec2> dragged_from{}; ///< where the button was pressed; none: at `mouse` itself
    bool down = false;                        ///< in the frame of the click; before the drag's end
    std::optional<render::OrbitCamera> camera{}; ///< of scenes that declare iCamera; none: the host's own
    std::vector<Setting> settings{};             ///< of knobs
    std::vector<Setting> definitions{};          ///< of `#define NAME` and `const … NAME`
    std::vector<std::string> channels{};         ///< `0=none`, as --channel has them
    std::string pass{};                          ///< empty: Image
};

/// iFrame is the one at 60 frames a second; before the start it is 0. `before`: so many frames earlier.
render::FrameInputs inputs_of(const Situation& situation, int before = 0);

/// From so many frames before the moment a scene with feedback is drawn: from its start would take days,
/// where nobody asks for just that.
int run_up_of(const Situation& situation);

/// With the situation's channels and settings. The error is one of theirs (ErrorCode::usage).
Result<scene::Scene> in_situation(scene::Scene scene, const Situation& situation);

/// `--size 64x36 --time 62.83 --mouse 3,4`: what `tidemark capture` wants after the scene.
std::string capture_options(const Situation& situation);

} // namespace tidemark::lab
