// GLFW's windows as the program's two kinds of them are made. Included by these only.
#pragma once

#include <memory>
#include <string>

struct GLFWwindow;

namespace tidemark::platform {

struct DestroyWindow {
    void operator()(GLFWwindow* window) const;
};
using GlfwWindow = std::unique_ptr<GLFWwindow, DestroyWindow>;

/// What the next one has: a context of OpenGL 4.5 by EGL, and no more than a picture needs.
void hint_window();

/// Why GLFW did not do what it was asked for last.
std::string last_glfw_error();

} // namespace tidemark::platform
