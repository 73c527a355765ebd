// The mouse in the form of ShaderToy's iMouse.
#pragma once

#include "base/extent.hpp"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace tidemark::render {

/// iMouse through press, drag and release. Coordinates are pixels from the bottom left, rounded down. xy
/// moves only while the button is down; zw holds the place of the press: z is positive while the button is
/// down, w only in the first frame drawn after the press.
struct Mouse {
    void press(double x, double y);
    void move(double x, double y);
    void release() { down = false; }

    /// Returns iMouse of the next frame.
    glm::vec4 uniform() const;
    /// Returns the mouse after a click; `now`: in the frame of the press itself.
    static Mouse clicked(glm::dvec2 at, bool now);
    /// Returns the mouse after a drag; `held`: the button is still down.
    static Mouse dragged(glm::dvec2 from, glm::dvec2 to, bool held);
    /// Scales the coordinates to a picture of another size.
    void stretch(Extent from, Extent to);
    /// Ends the first frame of a click; must be called after each frame.
    void frame_drawn() { is_new = false; }

    bool operator==(const Mouse&) const = default;

    glm::vec2 position{0};
    glm::vec2 pressed_at{0};
    bool down = false;
    bool is_new = false; ///< no frame has been drawn since the press
};

} // namespace tidemark::render
