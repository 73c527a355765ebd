// Creates GLFW windows for the program's two window classes; only they include it.
#pragma once

#include <memory>
#include <string>

struct GLFWwindow;

namespace tidemark::platform {

struct DestroyWindow {
    void operator()(GLFWwindow* window) const;
};
using GlfwWindow = std::unique_ptr<GLFWwindow, DestroyWindow>;

/// Sets GLFW's hints for the next window: an OpenGL 4.5 core context through EGL, without depth, stencil or
/// alpha.
void hint_window();

/// Returns GLFW's last error.
std::string last_glfw_error();

} // namespace tidemark::platform
