// The twin of shaders/lib/camera.glsl: a camera that stands at a place and is turned by the mouse.
#pragma once

#include "lab/knob_reader.hpp"
#include "lab/reference.hpp"

namespace tidemark::lab {

/// Rays of a scene with the knobs camera_position, yaw_range, pitch_range and focal_length. `untouched` is
/// the turn, in parts of the picture, while the mouse is at (0, 0); none: it is turned to that corner.
std::function<Ray(const glm::dvec2&)> mouse_camera(KnobReader& knobs, const ReferenceInputs& inputs,
                                                   const std::optional<glm::dvec2>& untouched = {});

} // namespace tidemark::lab
