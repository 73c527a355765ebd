#include "live/plugin/imgui_input.hpp"

#include "base/overloaded.hpp"

#include <imgui.h>

#include <algorithm>
#include <cfloat>

namespace tidemark::live {
namespace {

using platform::Key;

// Dear ImGui 1.87 replaced the state that a program fills (KeyMap, KeysDown) by a queue of events. Debian 12
// has 1.86, Debian 13 has 1.90; the functions below hide the difference.
#if IMGUI_VERSION_NUM < 18700
using KeyName = ImGuiKey_;

void set_key_state(ImGuiIO& io, KeyName, Key key, bool down) {
    io.KeysDown[size_t(key)] = down;
}
void set_modifier(ImGuiIO& io, Key key, bool down) {
    (key == Key::control ? io.KeyCtrl : key == Key::shift ? io.KeyShift : io.KeyAlt) = down;
}
void set_pointer(ImGuiIO& io, float x, float y) {
    io.MousePos = {x, y};
}
void set_button(ImGuiIO& io, int button, bool down) {
    io.MouseDown[button] = down;
}
void add_wheel(ImGuiIO& io, float right, float up) {
    io.MouseWheel += up;
    io.MouseWheelH += right;
}
#else
using KeyName = ImGuiKey;

void set_key_state(ImGuiIO& io, KeyName name, Key, bool down) {
    io.AddKeyEvent(name, down);
}
void set_modifier(ImGuiIO& io, Key key, bool down) {
    io.AddKeyEvent(key == Key::control ? ImGuiMod_Ctrl
                   : key == Key::shift ? ImGuiMod_Shift
                                       : ImGuiMod_Alt,
                   down);
}
void set_pointer(ImGuiIO& io, float x, float y) {
    io.AddMousePosEvent(x, y);
}
void set_button(ImGuiIO& io, int button, bool down) {
    io.AddMouseButtonEvent(button, down);
}
void add_wheel(ImGuiIO& io, float right, float up) {
    io.AddMouseWheelEvent(right, up);
}
#endif

/// The keys that text fields use.
constexpr std::pair<KeyName, Key> k_keys[] = {
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

void set_key(ImGuiIO& io, Key key, bool down) {
    if (key == Key::control || key == Key::shift || key == Key::alt)
        set_modifier(io, key, down);
    else if (const auto named = std::ranges::find(k_keys, key, &std::pair<KeyName, Key>::second);
             named != std::end(k_keys))
        // Pass keys only to text fields: Dear ImGui has shortcuts of its own that Tidemark does not offer.
        set_key_state(io, named->first, key, down && io.WantTextInput);
}

} // namespace

void set_up_input(ImGuiIO& io) {
#if IMGUI_VERSION_NUM < 18700
    for (const auto& [name, key] : k_keys)
        io.KeyMap[name] = platform::js_key_code(key);
#else
    // Handle all events of a frame in that frame: an idle window does not draw a second one for the
    // remainder.
    io.ConfigInputTrickleEventQueue = false;
#endif
}

void feed(ImGuiIO& io, const platform::InputEvent& event, int height) {
    const auto point = [&](const platform::PointerPosition& at) {
        set_pointer(io, float(at.x), float(height - at.y));
    };
    std::visit(
        Overloaded{
            [&](const platform::PointerMoved& moved) { point(moved.at); },
            [&](const platform::ButtonPressed& pressed) {
                point(pressed.at);
                set_button(io, int(pressed.button), true);
            },
            [&](const platform::ButtonReleased& released) { set_button(io, int(released.button), false); },
            [&](const platform::WheelTurned& turned) {
                add_wheel(io, float(turned.right), float(turned.up));
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
    for (int button = 0; button < ImGuiMouseButton_COUNT; ++button)
        set_button(io, button, false);
    for (const auto& [name, key] : k_keys)
        set_key_state(io, name, key, false);
    for (const Key modifier : {Key::control, Key::shift, Key::alt})
        set_modifier(io, modifier, false);
    set_pointer(io, -FLT_MAX, -FLT_MAX);
}

} // namespace tidemark::live
