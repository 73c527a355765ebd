// The twin of shaders/lib/camera.glsl: a camera that stands at a place and is turned by the mouse.
#pragma once

#include "fields/knob_reader.hpp"
#include "fields/reference.hpp"

namespace tidemark::fields {

/// Rays of a scene with the knobs camera_position, default_turn, yaw_range, pitch_range and focal_length.
std::function<Ray(const glm::dvec2&)> mouse_camera(KnobReader& knobs, const ReferenceInputs& inputs);

} // namespace tidemark::fields
