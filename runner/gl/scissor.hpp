// Restricts drawing to a rectangle while the object lives; one at a time per context.
#pragma once

#include "base/rectangle.hpp"

#include <GL/glcorearb.h>

namespace tidemark::gl {

class Scissor {
public:
    explicit Scissor(const Rectangle& box) {
        glEnable(GL_SCISSOR_TEST);
        glScissor(box.x, box.y, box.extent.width, box.extent.height);
    }
    ~Scissor() { glDisable(GL_SCISSOR_TEST); }
    Scissor(const Scissor&) = delete;
    Scissor& operator=(const Scissor&) = delete;
};

} // namespace tidemark::gl
