#include "window/glfw.hpp"

#include "base/error.hpp"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace tidemark::window {

using namespace host;

void DestroyWindow::operator()(GLFWwindow* window) const {
    glfwDestroyWindow(window);
}

void hint_window(bool es) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CLIENT_API, es ? GLFW_OPENGL_ES_API : GLFW_OPENGL_API);
    // EGL starts faster than GLX, headless drawing uses the same driver, and it has contexts without windows.
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, es ? 3 : 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, es ? 1 : 5);
    if (!es)
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_ALPHA_BITS, 0);
    glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_FALSE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "tidemark");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "tidemark");
}

std::string last_glfw_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "GLFW gives no reason";
}

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

struct KeyPair {
    int glfw;
    Key key;
};

constexpr KeyPair k_single_keys[] = {
    {GLFW_KEY_SPACE, Key::space},
    {GLFW_KEY_APOSTROPHE, Key::apostrophe},
    {GLFW_KEY_COMMA, Key::comma},
    {GLFW_KEY_MINUS, Key::minus},
    {GLFW_KEY_PERIOD, Key::period},
    {GLFW_KEY_SLASH, Key::slash},
    {GLFW_KEY_SEMICOLON, Key::semicolon},
    {GLFW_KEY_EQUAL, Key::equal},
    {GLFW_KEY_LEFT_BRACKET, Key::left_bracket},
    {GLFW_KEY_BACKSLASH, Key::backslash},
    {GLFW_KEY_RIGHT_BRACKET, Key::right_bracket},
    {GLFW_KEY_GRAVE_ACCENT, Key::grave_accent},
    {GLFW_KEY_WORLD_1, Key::world},
    {GLFW_KEY_WORLD_2, Key::world},
    {GLFW_KEY_ESCAPE, Key::escape},
    {GLFW_KEY_ENTER, Key::enter},
    {GLFW_KEY_TAB, Key::tab},
    {GLFW_KEY_BACKSPACE, Key::backspace},
    {GLFW_KEY_INSERT, Key::insert},
    {GLFW_KEY_DELETE, Key::del},
    {GLFW_KEY_RIGHT, Key::right},
    {GLFW_KEY_LEFT, Key::left},
    {GLFW_KEY_DOWN, Key::down},
    {GLFW_KEY_UP, Key::up},
    {GLFW_KEY_PAGE_UP, Key::page_up},
    {GLFW_KEY_PAGE_DOWN, Key::page_down},
    {GLFW_KEY_HOME, Key::home},
    {GLFW_KEY_END, Key::end},
    {GLFW_KEY_CAPS_LOCK, Key::caps_lock},
    {GLFW_KEY_SCROLL_LOCK, Key::scroll_lock},
    {GLFW_KEY_NUM_LOCK, Key::num_lock},
    {GLFW_KEY_PRINT_SCREEN, Key::print_screen},
    {GLFW_KEY_PAUSE, Key::pause},
    {GLFW_KEY_KP_DECIMAL, Key::keypad_decimal},
    {GLFW_KEY_KP_DIVIDE, Key::keypad_divide},
    {GLFW_KEY_KP_MULTIPLY, Key::keypad_multiply},
    {GLFW_KEY_KP_SUBTRACT, Key::keypad_subtract},
    {GLFW_KEY_KP_ADD, Key::keypad_add},
    {GLFW_KEY_KP_ENTER, Key::enter},
    {GLFW_KEY_KP_EQUAL, Key::equal},
    {GLFW_KEY_LEFT_SHIFT, Key::shift},
    {GLFW_KEY_RIGHT_SHIFT, Key::shift},
    {GLFW_KEY_LEFT_CONTROL, Key::control},
    {GLFW_KEY_RIGHT_CONTROL, Key::control},
    {GLFW_KEY_LEFT_ALT, Key::alt},
    {GLFW_KEY_RIGHT_ALT, Key::alt},
    {GLFW_KEY_LEFT_SUPER, Key::left_meta},
    {GLFW_KEY_RIGHT_SUPER, Key::right_meta},
    {GLFW_KEY_MENU, Key::menu},
};

/// Consecutive keys in both numberings.
struct KeyRun {
    int glfw_first;
    int glfw_last;
    Key first;
};

constexpr KeyRun k_key_runs[] = {
    {GLFW_KEY_0, GLFW_KEY_9, Key::digit_0},
    {GLFW_KEY_A, GLFW_KEY_Z, Key::a},
    {GLFW_KEY_KP_0, GLFW_KEY_KP_9, Key::keypad_0},
    {GLFW_KEY_F1, GLFW_KEY_F24, Key::f1},
};

bool is_keypad(int glfw_key) {
    return glfw_key >= GLFW_KEY_KP_0 && glfw_key <= GLFW_KEY_KP_EQUAL;
}

/// Returns the key of a single letter or digit; Key::unknown for all other names.
Key key_from_name(const char* name) {
    if (!name || name[0] == '\0' || name[1] != '\0')
        return Key::unknown;
    const char c = name[0];
    if (c >= 'a' && c <= 'z')
        return Key(int(Key::a) + (c - 'a'));
    if (c >= 'A' && c <= 'Z')
        return Key(int(Key::a) + (c - 'A'));
    if (c >= '0' && c <= '9')
        return Key(int(Key::digit_0) + (c - '0'));
    return Key::unknown;
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

Key key_from_glfw(int glfw_key, const char* key_name) {
    if (!is_keypad(glfw_key))
        if (const Key named = key_from_name(key_name); named != Key::unknown)
            return named;
    for (const KeyRun& run : k_key_runs)
        if (glfw_key >= run.glfw_first && glfw_key <= run.glfw_last)
            return Key(int(run.first) + (glfw_key - run.glfw_first));
    const auto pair = std::ranges::find(k_single_keys, glfw_key, &KeyPair::glfw);
    return pair != std::ranges::end(k_single_keys) ? pair->key : Key::unknown;
}

std::optional<InputEvent> key_event(int glfw_key, int scancode, int action) {
    const Key key = key_from_glfw(glfw_key, glfwGetKeyName(glfw_key, scancode));
    if (key == Key::unknown)
        return std::nullopt;
    if (action == GLFW_RELEASE)
        return KeyReleased{key};
    return KeyPressed{key, action == GLFW_REPEAT};
}

} // namespace tidemark::window
