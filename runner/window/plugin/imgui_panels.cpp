// Passes window events on to Dear ImGui: 1.86, which reads a state, or 1.89 and later, which have a queue.

#include "base/overloaded.hpp"
#include "host/input_events.hpp"
#include "host/overlay_model.hpp"
#include "window/plugin/imgui_drawing.hpp"
#include "window/plugin/panels.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <backends/imgui_impl_opengl3_loader.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cfloat>
#include <chrono>
#include <cmath>
#include <string_view>
#include <utility>

namespace tidemark::overlay {
namespace {

using host::Key;

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

/// Maps Tidemark's keys to those of Dear ImGui; called once, before the first frame.
void set_up_input(ImGuiIO& io) {
#if IMGUI_VERSION_NUM < 18700
    for (const auto& [name, key] : k_keys)
        io.KeyMap[name] = host::js_key_code(key);
#else
    // Handle all events of a frame in that frame: an idle window does not draw a second one for the
    // remainder.
    io.ConfigInputTrickleEventQueue = false;
#endif
}

/// Passes one event on. `height` of the framebuffer: Tidemark counts pixels from the bottom, Dear ImGui from
/// the top.
void feed(ImGuiIO& io, const host::InputEvent& event, int height) {
    const auto point = [&](const host::PointerPosition& at) {
        set_pointer(io, float(at.x), float(height - at.y));
    };
    std::visit(
        Overloaded{
            [&](const host::PointerMoved& moved) { point(moved.at); },
            [&](const host::ButtonPressed& pressed) {
                point(pressed.at);
                set_button(io, int(pressed.button), true);
            },
            [&](const host::ButtonReleased& released) { set_button(io, int(released.button), false); },
            [&](const host::WheelTurned& turned) { add_wheel(io, float(turned.right), float(turned.up)); },
            [&](const host::KeyPressed& pressed) { set_key(io, pressed.key, true); },
            [&](const host::KeyReleased& released) { set_key(io, released.key, false); },
            [&](const host::TextTyped& typed) {
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

bool is_escape(const host::InputEvent& event) {
    const auto* pressed = std::get_if<host::KeyPressed>(&event);
    return pressed && pressed->key == Key::escape;
}

/// Closes the innermost menu, list or colour picker; returns false if none is open.
bool close_popup() {
    const int open = ImGui::GetCurrentContext()->OpenPopupStack.Size;
    if (open > 0)
        ImGui::ClosePopupToLevel(open - 1, true);
    return open > 0;
}

/// Characters of messages and comments that Dear ImGui's own font lacks or has elsewhere, and what is drawn
/// for them.
constexpr std::pair<ImWchar, ImWchar> k_stand_ins[] = {
    {0x2026, 0x85}, // "…"
    {0x2010, '-'},  {0x2011, '-'},  {0x2012, '-'}, {0x2013, '-'}, {0x2014, '-'},  {0x2212, '-'},
    {0x2018, '\''}, {0x2019, '\''}, {0x201C, '"'}, {0x201D, '"'}, {0x2022, 0xB7}, {0x2192, '>'},
};

/// The size at which Dear ImGui's own font has whole pixels.
constexpr double k_font_pixels = 13;

/// Relative font size of the first error.
constexpr double k_large = 1.5;

ImFont* add_font(double scale) {
    ImFontConfig font;
    font.SizePixels = float(std::max(1.0, std::round(k_font_pixels * scale)));
    return ImGui::GetIO().Fonts->AddFontDefault(&font);
}

/// Returns whether the current context is one of OpenGL ES.
bool is_es() {
    const auto* const version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    return version && std::string_view(version).starts_with("OpenGL ES");
}

/// Removes the back end's calls about state that OpenGL ES lacks. Before 1.90.5 it takes ES 3.1 for OpenGL
/// 3.1.
void leave_out_desktop_state() {
    static const auto driver = imgl3wProcs.gl;
    imgl3wProcs.gl.PolygonMode = [](GLenum, GLenum) {};
    imgl3wProcs.gl.GetIntegerv = [](GLenum name, GLint* values) {
        if (name == GL_POLYGON_MODE)
            values[0] = values[1] = GL_FILL;
        else
            driver.GetIntegerv(name, values);
    };
    imgl3wProcs.gl.IsEnabled = [](GLenum state) {
        return state == GL_PRIMITIVE_RESTART ? GLboolean(GL_FALSE) : driver.IsEnabled(state);
    };
    imgl3wProcs.gl.Disable = [](GLenum state) {
        if (state != GL_PRIMITIVE_RESTART)
            driver.Disable(state);
    };
}

// The panels, drawn by Dear ImGui through its OpenGL 3 back end. Only one object may exist at a time.

class ImGuiPanels : public Panels {
public:
    ImGuiPanels() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr; // no settings file
        set_up_input(io);
        imgl3wInit(); // is_es needs its functions
        const bool es = is_es();
        ImGui_ImplOpenGL3_Init(es ? "#version 300 es" : "#version 450 core");
        if (es)
            leave_out_desktop_state();
    }

    ~ImGuiPanels() override {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui::DestroyContext();
    }

    ImGuiPanels(const ImGuiPanels&) = delete;
    ImGuiPanels& operator=(const ImGuiPanels&) = delete;

    void show(Model model, const Surface& surface) override {
        if (surface.scale != surface_.scale)
            adopt(surface.scale);
        surface_ = surface;
        keep_changing(model_.definitions, model.definitions);
        model_ = std::move(model);
    }

    /// Runs Dear ImGui after each event, so that a press and its release within one frame are both seen, and
    /// hit tests use the current layout.
    bool take(const host::InputEvent& event) override {
        ImGuiIO& io = ImGui::GetIO();
        const bool typing = io.WantTextInput; // the key that ends typing still belongs to the field
        const bool closes = !typing && is_escape(event) && close_popup();
        feed(io, event, surface_.extent.height);
        run();
        run(); // the result of the first run is needed to know whether a field has the keyboard
        return owner_.take(event, {io.WantCaptureMouse, typing || closes});
    }

    void draw() override {
        run();
        if (model_.lens || !model_.status.empty())
            run();           // their height follows their text
        glBindSampler(0, 0); // that of a channel, which the back end leaves bound in OpenGL ES before 1.89.6
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    }

    Commands take_commands() override { return std::exchange(commands_, {}); }

    void release_all() override {
        overlay::release_all(ImGui::GetIO());
        owner_.release_all();
    }

private:
    void run() {
        const auto now = std::chrono::steady_clock::now();
        constexpr float k_shortest = 1e-5F; // Dear ImGui divides by it
        ImGuiIO& io = ImGui::GetIO();
        io.DeltaTime =
            std::max(k_shortest, std::chrono::duration<float>(now - std::exchange(ran_at_, now)).count());
        io.DisplaySize = {float(surface_.extent.width), float(surface_.extent.height)};
        ImGui_ImplOpenGL3_NewFrame();
        ImGui::NewFrame();
        float bottom = 0;
        if (model_.controls) {
            if (model_.large)
                draw_large(model_.pictures[*model_.large], surface_);
            bottom = draw_time_bar(model_, surface_, commands_);
        }
        if (!model_.status.empty())
            bottom += draw_status_line(model_.status, surface_, bottom);
        if (model_.controls)
            draw_controls(model_, surface_, bottom, commands_);
        if (model_.lens)
            draw_legend(*model_.lens, surface_, bottom);
        if (!model_.errors.empty())
            draw_errors(model_, surface_, {large_, bottom}, commands_);
        if (!model_.help.empty())
            draw_help(model_, surface_, bottom);
        if (model_.magnifier)
            draw_magnifier(*model_.magnifier, surface_);
        if (!model_.gallery.empty())
            draw_gallery(model_, surface_, commands_);
        if (!model_.clock.empty())
            draw_clock(model_.clock, surface_);
        draw_messages(model_, surface_);
        ImGui::Render();
    }

    /// Scales the widgets and the font to another pixel density.
    void adopt(double scale) {
        ImGuiStyle style;
        ImGui::StyleColorsDark(&style);
        style.WindowRounding = style.FrameRounding = 3;
        style.Colors[ImGuiCol_WindowBg].w = 0.85F;
        style.ScaleAllSizes(float(scale));
        ImGui::GetStyle() = style;
        ImGuiIO& io = ImGui::GetIO();
        io.Fonts->Clear();
        add_font(scale);
        large_ = add_font(k_large * scale);
        io.Fonts->Build();
        for (ImFont* font : io.Fonts->Fonts)
            for (const auto& [character, drawn] : k_stand_ins)
                font->AddRemapChar(character, drawn);
        ImGui_ImplOpenGL3_DestroyDeviceObjects(); // the next frame creates them again, with that font
    }

    Model model_;
    Surface surface_{{1, 1}, 0};
    ImFont* large_ = nullptr;
    Commands commands_;
    EventOwner owner_;
    std::chrono::steady_clock::time_point ran_at_ = std::chrono::steady_clock::now();
};

const PanelsPlugIn k_plug_in{k_panels_version,
                             []() -> std::unique_ptr<Panels> { return std::make_unique<ImGuiPanels>(); }};

} // namespace
} // namespace tidemark::overlay

extern "C" __attribute__((visibility("default"))) const void* tidemark_panels() {
    return &tidemark::overlay::k_plug_in;
}
