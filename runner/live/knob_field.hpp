// A knob as a field that can be edited: its widget and the values it allows. Draws nothing.
#pragma once

#include "scene/knob.hpp"

#include <string>
#include <vector>

namespace tidemark::live {

/// The MIDI binding of one component of a knob.
struct ControllerField {
    std::string part;
    std::string controller{}; ///< bound to it; empty: none
    bool learning = false;    ///< the next controller that moves will be bound
};

struct KnobField {
    scene::Knob knob; ///< as the scene declares it
    scene::KnobValue value{};
    std::vector<ControllerField> controllers{}; ///< MIDI bindings, one a component; empty: no device

    bool is_turned() const { return value != knob.initial; }
};

enum class Widget { check_box, colour, slider, drag };

/// Returns the widget for a knob: a check box for a range of only two values, a slider for other ranges, a
/// drag field without a range or where its length overflows a double.
Widget widget_of(const scene::Knob& knob);

/// Returns whether the knob's type can hold the number, which may be typed by hand.
bool takes(const scene::Knob& knob, double number);

/// Returns the value nearest to `number` that the knob's step allows, counted from the low end of its range.
double in_steps(const scene::Knob& knob, size_t component, double number);

/// Returns the change for each pixel of dragging, for a field without a range.
double drag_speed(const scene::Knob& knob, size_t component);

} // namespace tidemark::live
