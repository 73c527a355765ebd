// The monitors that a window can be on, as GLFW lists them while it runs. Included by the windows only.
#pragma once

#include "base/result.hpp"
#include "platform/window_wishes.hpp"

struct GLFWmonitor;
struct GLFWwindow;

namespace tidemark::platform {

/// In GLFW's screen coordinates, origin at the top left.
struct ScreenArea {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

struct Monitor {
    GLFWmonitor* handle = nullptr; ///< null: there is none
    ScreenArea place;
    int refresh_rate = 0;
};

ScreenArea place_of(GLFWwindow* window);

/// The one that shows most of it.
Monitor monitor_under(const ScreenArea& window);

/// 1 is the first. ErrorCode::usage, with `option`'s name, where there are not so many.
Result<Monitor> monitor_numbered(int number, const char* option);

/// Moves a window that is hidden yet to where it is wished, as far as a monitor shows that. What is typed and
/// cannot be is an ErrorCode::usage.
Result<void> move_to_wished(GLFWwindow* window, const WindowWishes& wishes);

} // namespace tidemark::platform
