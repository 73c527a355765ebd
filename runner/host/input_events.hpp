// Input events of a window, as data. Positions are in framebuffer pixels from the bottom left, like GLSL's
// gl_FragCoord. The meaning of keys and drags is not defined here.
#pragma once

#include "base/extent.hpp"

#include <string>
#include <variant>
#include <vector>

namespace tidemark::host {

enum class Button { left, right, middle };

/// A key; its value is its JavaScript `keyCode`, the index into ShaderToy's keyboard texture. Left and right
/// modifiers share a value, as there. Punctuation has Chrome's values.
enum class Key : int {
    unknown = 0,
    backspace = 8,
    tab = 9,
    enter = 13, ///< the keypad's too
    shift = 16,
    control = 17,
    alt = 18,
    pause = 19,
    caps_lock = 20,
    escape = 27,
    space = 32,
    page_up = 33,
    page_down = 34,
    end = 35,
    home = 36,
    left = 37,
    up = 38,
    right = 39,
    down = 40,
    print_screen = 44,
    insert = 45,
    del = 46,
    digit_0 = 48, ///< to digit_9 = 57
    digit_9 = 57,
    a = 65, ///< to z = 90
    c = 67,
    f = 70,
    h = 72,
    k = 75,
    m = 77,
    n = 78,
    r = 82,
    s = 83,
    z = 90,
    left_meta = 91,
    right_meta = 92,
    menu = 93,
    keypad_0 = 96, ///< to keypad_9 = 105
    keypad_9 = 105,
    keypad_multiply = 106,
    keypad_add = 107,
    keypad_subtract = 109,
    keypad_decimal = 110,
    keypad_divide = 111,
    f1 = 112, ///< to f24 = 135
    f24 = 135,
    num_lock = 144,
    scroll_lock = 145,
    semicolon = 186,
    equal = 187,
    comma = 188,
    minus = 189,
    period = 190,
    slash = 191,
    grave_accent = 192,
    left_bracket = 219,
    backslash = 220,
    right_bracket = 221,
    apostrophe = 222,
    world = 226, ///< the extra key of non-American keyboards
};

/// Returns the key's column in ShaderToy's keyboard texture, 0 to 255; 0 is not a JavaScript key.
constexpr int js_key_code(Key key) {
    return int(key);
}

/// Pixels from the bottom-left corner of the framebuffer; pixel centres are at .5. A drag may leave the
/// window, so any value is possible.
struct PointerPosition {
    double x = 0;
    double y = 0;
    bool operator==(const PointerPosition&) const = default;
};

struct PointerMoved {
    PointerPosition at;
    bool operator==(const PointerMoved&) const = default;
};

struct ButtonPressed {
    Button button = Button::left;
    PointerPosition at;
    bool operator==(const ButtonPressed&) const = default;
};

struct ButtonReleased {
    Button button = Button::left;
    PointerPosition at{};
    bool operator==(const ButtonReleased&) const = default;
};

/// In notches; `up` is positive when the wheel turns away from the user.
struct WheelTurned {
    double right = 0;
    double up = 0;
    bool operator==(const WheelTurned&) const = default;
};

struct KeyPressed {
    Key key = Key::unknown;
    bool repeat = false; ///< the key was already down; ShaderToy ignores these
    bool operator==(const KeyPressed&) const = default;
};

struct KeyReleased {
    Key key = Key::unknown;
    bool operator==(const KeyReleased&) const = default;
};

/// A character typed, by the user's keyboard layout; it follows its KeyPressed, if there is one.
struct TextTyped {
    char32_t character = 0;
    bool operator==(const TextTyped&) const = default;
};

/// The new size; 0x0 for a minimised window on some systems.
struct FramebufferResized {
    Extent extent;
    bool operator==(const FramebufferResized&) const = default;
};

/// The window's contents were lost (it was covered, for example) and must be drawn again.
struct RedrawNeeded {
    bool operator==(const RedrawNeeded&) const = default;
};

struct CloseRequested {
    bool operator==(const CloseRequested&) const = default;
};

/// Releases of all keys and buttons that were down follow at once.
struct FocusLost {
    bool operator==(const FocusLost&) const = default;
};

/// Files that were dragged from another program and dropped on the window.
struct FilesDropped {
    std::vector<std::string> paths;
    bool operator==(const FilesDropped&) const = default;
};

using InputEvent =
    std::variant<PointerMoved, ButtonPressed, ButtonReleased, WheelTurned, KeyPressed, KeyReleased, TextTyped,
                 FramebufferResized, RedrawNeeded, CloseRequested, FocusLost, FilesDropped>;

} // namespace tidemark::host
