// The mouse as ShaderToy's shaders see it.
#pragma once

#include "base/extent.hpp"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace tidemark::render {

/// iMouse through press, drag and release. Coordinates are pixels from the bottom left, made whole by
/// rounding down. xy moves only while the button is down; zw holds where it was pressed: z is positive while
/// the button is down, w only in the first frame drawn after the press.
struct Mouse {
    void press(double x, double y);
    void move(double x, double y);
    void release() { down = false; }

    /// iMouse of the next frame.
    glm::vec4 uniform() const;
    /// After a click at that place; `now`: in the very frame of the press.
    static Mouse clicked(glm::dvec2 at, bool now);
    /// After a drag from the one place to the other; `held`: the button is still down.
    static Mouse dragged(glm::dvec2 from, glm::dvec2 to, bool held);
    /// To the same place of a picture of another size.
    void stretch(Extent from, Extent to);
    /// To be called when a frame has been drawn: the click is then no longer new.
    void frame_drawn() { is_new = false; }

    bool operator==(const Mouse&) const = default;

    glm::vec2 position{0};
    glm::vec2 pressed_at{0};
    bool down = false;
    bool is_new = false; ///< no frame has been drawn since the press
};

} // namespace tidemark::render
