// Helpers around GLFW: creating windows, monitors, keys.
//
// Creates GLFW windows for the program's two window classes; only they include it.
#pragma once

#include "base/error.hpp"
#include "host/input_events.hpp"
#include "window/window.hpp"

#include <memory>
#include <optional>
#include <string>

struct GLFWwindow;

namespace tidemark::window {

struct DestroyWindow {
    void operator()(GLFWwindow* window) const;
};
using GlfwWindow = std::unique_ptr<GLFWwindow, DestroyWindow>;

/// Sets GLFW's hints for the next window: an OpenGL 4.5 core context, or with `es` one of OpenGL ES 3.1,
/// through EGL, without depth, stencil or alpha.
void hint_window(bool es);

/// Returns GLFW's last error.
std::string last_glfw_error();

} // namespace tidemark::window

// Finds the monitors on which a window can be, through GLFW, which must run. Only the windows include it.

struct GLFWmonitor;
struct GLFWwindow;

namespace tidemark::window {

/// A rectangle in GLFW's screen coordinates, origin at the top left.
struct ScreenArea {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

struct Monitor {
    GLFWmonitor* handle = nullptr; ///< null: no monitor
    ScreenArea place;
    int refresh_rate = 0;
};

ScreenArea place_of(GLFWwindow* window);

/// Returns the monitor that shows most of the window.
Monitor monitor_under(const ScreenArea& window);

/// Returns a monitor by number; 1 is the first. ErrorCode::usage, with the option's name, if there are fewer.
Result<Monitor> monitor_numbered(int number, const char* option);

/// Moves a window that is still hidden to the requested place, if a monitor shows it. ErrorCode::usage if a
/// place that the user gave is not shown.
Result<void> move_to_wished(GLFWwindow* window, const WindowWishes& wishes);

// Converts GLFW's keys. Only the windows include it.

/// Returns the key's JavaScript code: by the letter or digit that the user's keyboard layout prints on it (so
/// Z is where German keyboards have it), else by its place on an American keyboard. `key_name` is
/// glfwGetKeyName's result; it may be null.
host::Key key_from_glfw(int glfw_key, const char* key_name);

/// Converts the arguments of GLFW's key callback; nullopt for a key without a code.
std::optional<host::InputEvent> key_event(int glfw_key, int scancode, int action);

} // namespace tidemark::window
