#include "live/plugin/imgui_input.hpp"

#include "base/overloaded.hpp"

#include <imgui.h>

#include <algorithm>
#include <cfloat>

namespace tidemark::live {
namespace {

using platform::Key;

void set_key(ImGuiIO& io, Key key, bool down) {
    switch (key) {
    case Key::control: io.KeyCtrl = down; break;
    case Key::shift: io.KeyShift = down; break;
    case Key::alt: io.KeyAlt = down; break;
    default:
        // Outside of fields keys are not its own: it has shortcuts that we have not.
        io.KeysDown[size_t(key)] = down && io.WantTextInput;
    }
}

} // namespace

void name_keys(ImGuiIO& io) {
    constexpr std::pair<ImGuiKey_, Key> k_names[] = {
        {ImGuiKey_Tab, Key::tab},
        {ImGuiKey_LeftArrow, Key::left},
        {ImGuiKey_RightArrow, Key::right},
        {ImGuiKey_UpArrow, Key::up},
        {ImGuiKey_DownArrow, Key::down},
        {ImGuiKey_Home, Key::home},
        {ImGuiKey_End, Key::end},
        {ImGuiKey_Delete, Key::del},
        {ImGuiKey_Backspace, Key::backspace},
        {ImGuiKey_Enter, Key::enter},
        {ImGuiKey_Escape, Key::escape},
        {ImGuiKey_A, Key::a},
        {ImGuiKey_C, Key(67)},
        {ImGuiKey_V, Key(86)},
        {ImGuiKey_X, Key(88)},
        {ImGuiKey_Y, Key(89)},
        {ImGuiKey_Z, Key::z},
    };
    for (const auto& [name, key] : k_names)
        io.KeyMap[name] = platform::js_key_code(key);
}

void feed(ImGuiIO& io, const platform::InputEvent& event, int height) {
    const auto point = [&](const platform::PointerPosition& at) {
        io.MousePos = {float(at.x), float(height - at.y)};
    };
    std::visit(
        Overloaded{
            [&](const platform::PointerMoved& moved) { point(moved.at); },
            [&](const platform::ButtonPressed& pressed) {
                point(pressed.at);
                io.MouseDown[size_t(pressed.button)] = true;
            },
            [&](const platform::ButtonReleased& released) { io.MouseDown[size_t(released.button)] = false; },
            [&](const platform::WheelTurned& turned) {
                io.MouseWheel += float(turned.up);
                io.MouseWheelH += float(turned.right);
            },
            [&](const platform::KeyPressed& pressed) { set_key(io, pressed.key, true); },
            [&](const platform::KeyReleased& released) { set_key(io, released.key, false); },
            [&](const platform::TextTyped& typed) {
                if (io.WantTextInput)
                    io.AddInputCharacter(typed.character);
            },
            [](const auto&) {},
        },
        event);
}

void release_all(ImGuiIO& io) {
    std::ranges::fill(io.MouseDown, false);
    std::ranges::fill(io.KeysDown, false);
    io.KeyCtrl = io.KeyShift = io.KeyAlt = false;
    io.MousePos = {-FLT_MAX, -FLT_MAX};
}

} // namespace tidemark::live
