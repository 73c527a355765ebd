#include "render/mouse.hpp"

#include <cmath>

namespace tidemark::render {

void Mouse::press(double x, double y) {
    down_ = true;
    clicked_ = true;
    move(x, y);
    pressed_at_ = position_;
}

void Mouse::move(double x, double y) {
    if (down_)
        position_ = {float(std::floor(x)) + 0.0f, float(std::floor(y)) + 0.0f}; // -0 + 0 is 0
}

glm::vec4 Mouse::uniform() const {
    // 0 - x rather than -x: a press at pixel 0 must not give a negative zero.
    return {position_.x, position_.y, down_ ? pressed_at_.x : 0 - pressed_at_.x,
            clicked_ ? pressed_at_.y : 0 - pressed_at_.y};
}

glm::vec4 Mouse::clicked(double x, double y, bool now) {
    Mouse mouse;
    mouse.press(x, y);
    if (!now) {
        mouse.frame_drawn();
        mouse.release();
    }
    return mouse.uniform();
}

glm::vec4 Mouse::dragged(glm::dvec2 from, glm::dvec2 to, bool held) {
    Mouse mouse;
    mouse.press(from.x, from.y);
    mouse.frame_drawn();
    mouse.move(to.x, to.y);
    if (!held)
        mouse.release();
    return mouse.uniform();
}

} // namespace tidemark::render
