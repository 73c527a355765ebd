// Finds the monitors on which a window can be, through GLFW, which must run. Only the windows include it.
#pragma once

#include "base/result.hpp"
#include "platform/window_wishes.hpp"

struct GLFWmonitor;
struct GLFWwindow;

namespace tidemark::platform {

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

} // namespace tidemark::platform
