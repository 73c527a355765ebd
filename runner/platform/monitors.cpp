#include "platform/monitors.hpp"

#include "base/try.hpp"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace tidemark::platform {
namespace {

int common_area(const ScreenArea& a, const ScreenArea& b) {
    const int width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
    const int height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
    return std::max(width, 0) * std::max(height, 0);
}

std::vector<Monitor> all_monitors() {
    int count = 0;
    GLFWmonitor** handles = glfwGetMonitors(&count);
    std::vector<Monitor> monitors;
    for (GLFWmonitor* handle : std::span(handles, size_t(count)))
        if (const GLFWvidmode* mode = glfwGetVideoMode(handle)) {
            Monitor monitor{handle, {0, 0, mode->width, mode->height}, mode->refreshRate};
            glfwGetMonitorPos(handle, &monitor.place.x, &monitor.place.y);
            monitors.push_back(monitor);
        }
    return monitors;
}

bool is_shown(const ScreenArea& place) {
    const Monitor monitor = monitor_under(place);
    return monitor.handle && common_area(place, monitor.place) > 0;
}

ScreenArea centred(ScreenArea window, const ScreenArea& monitor) {
    window.x = monitor.x + std::max(0, monitor.width - window.width) / 2;
    window.y = monitor.y + std::max(0, monitor.height - window.height) / 2;
    return window;
}

/// Lists the monitors: `monitor 1 is 1280x800 at 0,0`.
std::string words_on_monitors() {
    std::vector<std::string> words;
    for (const Monitor& monitor : all_monitors()) {
        const auto& [x, y, width, height] = monitor.place;
        words.push_back(fmt::format("monitor {} is {}x{} at {},{}", words.size() + 1, width, height, x, y));
    }
    return words.empty() ? "there is no monitor" : fmt::format("{}", fmt::join(words, ", "));
}

} // namespace

ScreenArea place_of(GLFWwindow* window) {
    ScreenArea place;
    glfwGetWindowPos(window, &place.x, &place.y);
    glfwGetWindowSize(window, &place.width, &place.height);
    return place;
}

Monitor monitor_under(const ScreenArea& window) {
    const std::vector<Monitor> monitors = all_monitors();
    const auto area = [&](const Monitor& monitor) { return common_area(window, monitor.place); };
    const auto most = std::ranges::max_element(monitors, {}, area);
    return most == monitors.end() ? Monitor() : *most;
}

Result<Monitor> monitor_numbered(int number, const char* option) {
    const std::vector<Monitor> monitors = all_monitors();
    if (number >= 1 && size_t(number) <= monitors.size())
        return monitors[size_t(number) - 1];
    return fail(ErrorCode::usage,
                fmt::format("{} {}: there is no such monitor: {}", option, number, words_on_monitors()));
}

Result<void> move_to_wished(GLFWwindow* window, const WindowWishes& wishes) {
    ScreenArea place = place_of(window);
    const auto move = [&] { glfwSetWindowPos(window, place.x, place.y); };
    if (wishes.monitor)
        place = centred(place, TRY(monitor_numbered(*wishes.monitor, "--monitor")).place);
    if (const auto& corner = wishes.position) {
        const ScreenArea from =
            wishes.monitor ? TRY(monitor_numbered(*wishes.monitor, "--monitor")).place : ScreenArea();
        place.x = from.x + corner->x;
        place.y = from.y + corner->y;
        if (!is_shown(place))
            return fail(ErrorCode::usage, fmt::format("--position {},{}: no monitor shows that place: {}",
                                                      corner->x, corner->y, words_on_monitors()));
    }
    if (wishes.monitor || wishes.position) {
        move();
    } else if (wishes.left_at) { // the monitor of last time may be gone
        place.x = wishes.left_at->x;
        place.y = wishes.left_at->y;
        if (is_shown(place))
            move();
    }
    return {};
}

} // namespace tidemark::platform
