#include "platform/window_keys.hpp"

#include <GLFW/glfw3.h>

#include <algorithm>

namespace tidemark::platform {
namespace {

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

} // namespace tidemark::platform
