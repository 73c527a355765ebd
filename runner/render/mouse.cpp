#include "render/mouse.hpp"

#include <glm/common.hpp>

#include <cmath>

namespace tidemark::render {

void Mouse::press(double x, double y) {
    down = true;
    is_new = true;
    move(x, y);
    pressed_at = position;
}

void Mouse::move(double x, double y) {
    if (down)
        position = {float(std::floor(x)) + 0.0f, float(std::floor(y)) + 0.0f}; // -0 + 0 is 0
}

glm::vec4 Mouse::uniform() const {
    // 0 - x rather than -x: a press at pixel 0 must not give a negative zero.
    return {position.x, position.y, down ? pressed_at.x : 0 - pressed_at.x,
            is_new ? pressed_at.y : 0 - pressed_at.y};
}

Mouse Mouse::clicked(glm::dvec2 at, bool now) {
    Mouse mouse;
    mouse.press(at.x, at.y);
    if (!now) {
        mouse.frame_drawn();
        mouse.release();
    }
    return mouse;
}

Mouse Mouse::dragged(glm::dvec2 from, glm::dvec2 to, bool held) {
    Mouse mouse;
    mouse.press(from.x, from.y);
    mouse.frame_drawn();
    mouse.move(to.x, to.y);
    if (!held)
        mouse.release();
    return mouse;
}

void Mouse::stretch(Extent from, Extent to) {
    const glm::vec2 scale{double(to.width) / from.width, double(to.height) / from.height};
    position = glm::floor(position * scale);
    pressed_at = glm::floor(pressed_at * scale);
}

} // namespace tidemark::render
