// A knob as a field that a hand turns: which widget fits it, and which values that gives. Draws nothing.
#pragma once

#include "scene/knob.hpp"

#include <string>
#include <vector>

namespace tidemark::live {

/// What a MIDI device has to do with one component of a knob.
struct ControllerField {
    std::string part;         ///< `height`, `tint.g`
    std::string controller{}; ///< that turns it; empty: none
    bool learning = false;    ///< the next one that moves will
};

struct KnobField {
    scene::Knob knob; ///< what the scene says of it
    scene::KnobValue value{};
    std::vector<ControllerField> controllers{}; ///< one a component where there is a MIDI device

    bool is_turned() const { return value != knob.initial; }
};

enum class Widget { check_box, colour, slider, drag };

/// A range that holds two values alone is a check box; without a range, or with one that has no length in
/// doubles, there is no slider.
Widget widget_of(const scene::Knob& knob);

/// Whether the knob can have that component: people type what they like.
bool takes(const scene::Knob& knob, double number);

/// The value of a component nearest to `number` that the knob's step allows, counted from its low end.
double in_steps(const scene::Knob& knob, size_t component, double number);

/// So much a field without a range changes with each pixel that it is dragged.
double drag_speed(const scene::Knob& knob, size_t component);

} // namespace tidemark::live
