// The mouse as ShaderToy's shaders see it.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace tidemark::render {

/// iMouse through press, drag and release. Coordinates are pixels from the bottom left, made whole by
/// rounding down. xy moves only while the button is down; zw holds where it was pressed: z is positive while
/// the button is down, w only in the first frame drawn after the press.
class Mouse {
public:
    void press(double x, double y);
    void move(double x, double y);
    void release() { down_ = false; }

    /// iMouse of the next frame.
    glm::vec4 uniform() const;
    /// iMouse after a click at that place; `now`: in the very frame of the press.
    static glm::vec4 clicked(double x, double y, bool now);
    /// iMouse after a drag from the one place to the other; `held`: the button is still down.
    static glm::vec4 dragged(glm::dvec2 from, glm::dvec2 to, bool held);
    /// To be called when a frame has been drawn: the click is then no longer new.
    void frame_drawn() { clicked_ = false; }

private:
    glm::vec2 position_{0};
    glm::vec2 pressed_at_{0};
    bool down_ = false;
    bool clicked_ = false;
};

} // namespace tidemark::render
