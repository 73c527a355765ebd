#include "live/plugin/imgui_panels.hpp"

#include "live/plugin/clock_panel.hpp"
#include "live/plugin/controls_panel.hpp"
#include "live/plugin/error_panel.hpp"
#include "live/plugin/help_panel.hpp"
#include "live/plugin/imgui_input.hpp"
#include "live/plugin/magnifier_panel.hpp"
#include "live/plugin/picture_widgets.hpp"
#include "live/plugin/time_bar.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tidemark::live {
namespace {

/// The size at which Dear ImGui's own font has whole pixels.
constexpr double k_font_pixels = 13;

/// Relative font size of the first error.
constexpr double k_large = 1.5;

ImFont* add_font(double scale) {
    ImFontConfig font;
    font.SizePixels = float(std::max(1.0, std::round(k_font_pixels * scale)));
    return ImGui::GetIO().Fonts->AddFontDefault(&font);
}

constexpr const char* k_glsl_version = "#version 450 core";

} // namespace

ImGuiPanels::ImGuiPanels() {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // no settings file
    set_up_input(io);
    ImGui_ImplOpenGL3_Init(k_glsl_version);
}

ImGuiPanels::~ImGuiPanels() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

/// Scales the widgets and the font to another pixel density.
void ImGuiPanels::adopt(double scale) {
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
    ImGui_ImplOpenGL3_DestroyDeviceObjects(); // the next frame creates them again, with that font
}

void ImGuiPanels::show(Model model, const Surface& surface) {
    if (surface.scale != surface_.scale)
        adopt(surface.scale);
    surface_ = surface;
    keep_changing(model_.definitions, model.definitions);
    model_ = std::move(model);
}

/// Runs Dear ImGui after each event, so that a press and its release within one frame are both seen, and hit
/// tests use the current layout.
bool ImGuiPanels::take(const platform::InputEvent& event) {
    ImGuiIO& io = ImGui::GetIO();
    const bool typing = io.WantTextInput; // the key that ends typing still belongs to the field
    feed(io, event, surface_.extent.height);
    run();
    run(); // the result of the first run is needed to know whether a field has the keyboard
    return owner_.take(event, {io.WantCaptureMouse, typing});
}

void ImGuiPanels::run() {
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
        draw_controls(model_, surface_, commands_);
        bottom = draw_time_bar(model_, surface_, commands_);
    }
    if (!model_.errors.empty())
        draw_errors(model_, surface_, {large_, bottom}, commands_);
    if (!model_.help.empty())
        draw_help(model_, surface_);
    if (model_.magnifier)
        draw_magnifier(*model_.magnifier, surface_);
    if (!model_.clock.empty())
        draw_clock(model_.clock, surface_);
    ImGui::Render();
}

void ImGuiPanels::draw() {
    run();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

Commands ImGuiPanels::take_commands() {
    return std::exchange(commands_, {});
}

void ImGuiPanels::release_all() {
    live::release_all(ImGui::GetIO());
    owner_.release_all();
}

namespace {

const PanelsPlugIn k_plug_in{k_panels_version,
                             []() -> std::unique_ptr<Panels> { return std::make_unique<ImGuiPanels>(); }};

} // namespace
} // namespace tidemark::live

extern "C" __attribute__((visibility("default"))) const void* tidemark_panels() {
    return &tidemark::live::k_plug_in;
}
