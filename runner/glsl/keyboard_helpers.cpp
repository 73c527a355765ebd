#include "glsl/prologue.hpp"

#include <fmt/format.h>

namespace tidemark::glsl {
namespace {

struct Key {
    std::string_view name;
    int code; ///< JavaScript's key code
};

constexpr Key k_keys[] = {
    {"Backspace", 8},      {"Tab", 9},
    {"Enter", 13},         {"Shift", 16},
    {"Ctrl", 17},          {"Alt", 18},
    {"Pause", 19},         {"Caps", 20},
    {"Escape", 27},        {"Space", 32},
    {"PageUp", 33},        {"PageDown", 34},
    {"End", 35},           {"Home", 36},
    {"LeftArrow", 37},     {"UpArrow", 38},
    {"RightArrow", 39},    {"DownArrow", 40},
    {"Insert", 45},        {"Delete", 46},
    {"LeftWindow", 91},    {"RightWindow", 92},
    {"Select", 93},        {"NumpadMultiply", 106},
    {"NumpadAdd", 107},    {"NumpadSubtract", 109},
    {"NumpadPeriod", 110}, {"NumpadDivide", 111},
    {"NumLock", 144},      {"ScrollLock", 145},
    {"SemiColon", 186},    {"Equal", 187},
    {"Comma", 188},        {"Dash", 189},
    {"Period", 190},       {"ForwardSlash", 191},
    {"GraveAccent", 192},  {"OpenBracket", 219},
    {"BackSlash", 220},    {"CloseBracket", 221},
    {"CloseBraket", 221},  {"SingleQuote", 222},
};

constexpr std::string_view k_functions[] = {"isKeyDown", "isKeyPressed", "isKeyToggled", "isKeyReleased"};

} // namespace

std::string keyboard_helpers() {
    std::string text = "uniform sampler2D iKeyboard;\n";
    for (size_t row = 0; row < std::size(k_functions); ++row)
        text +=
            fmt::format("bool {}(int key) {{ return texelFetch(iKeyboard, ivec2(key, {}), 0).x > 0.0; }}\n",
                        k_functions[row], row);
    const auto add = [&](std::string_view name, int code) {
        text += fmt::format("const int Key_{} = {};\n", name, code);
    };
    for (const Key& key : k_keys)
        add(key.name, key.code);
    for (char c = '0'; c <= '9'; ++c) {
        add(std::string(1, c), c);
        add(fmt::format("Numpad{}", c), 96 + (c - '0'));
    }
    for (char c = 'A'; c <= 'Z'; ++c)
        add(std::string(1, c), c);
    for (int i = 1; i <= 12; ++i)
        add(fmt::format("F{}", i), 111 + i);
    return text;
}

} // namespace tidemark::glsl
