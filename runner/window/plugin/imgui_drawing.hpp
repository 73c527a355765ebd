// Draws text from users or their files, cut to a length that any screen can show. Dear ImGui aborts the
// program at more than 16,384 characters in one call.
#pragma once

#include "base/encoding.hpp"
#include "window/plugin/panels.hpp"

#include <imgui.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace tidemark::overlay {

/// The flags of a panel without title and border, as large as its contents.
inline constexpr auto k_bare_panel =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing;

/// Returns at most 2,000 bytes of a text, for a label or a line.
inline std::string shown(std::string_view text) {
    constexpr size_t k_most_bytes = 2000;
    return cut_text(text, k_most_bytes);
}

inline void draw_text(std::string_view text) {
    ImGui::TextUnformatted(shown(text).c_str());
}

/// Draws a text wrapped to the panel's width.
inline void draw_wrapped(std::string_view text) {
    ImGui::PushTextWrapPos(0);
    draw_text(text);
    ImGui::PopTextWrapPos();
}

/// Draws a name in at most `room` pixels; a longer one ends in "…", and the pointer over it shows all of it.
inline void draw_name_within(std::string_view name, float room) {
    const std::string all = shown(name);
    std::string part = all;
    char last = 0;
    const bool fits = ImGui::CalcTextSize(all.c_str()).x <= room;
    while (!fits && part.size() > 1 && ImGui::CalcTextSize((part + "…").c_str()).x > room)
        do { // a whole character
            last = part.back();
            part.pop_back();
        } while (part.size() > 1 && continues_character(last));
    ImGui::TextUnformatted((fits ? all : part + "…").c_str());
    if (!fits && ImGui::IsItemHovered())
        ImGui::SetTooltip("%s", all.c_str());
}

/// Returns the room for a name in the current row, before a button with that label if there is one.
inline float name_room(const char* button) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float taken = ImGui::CalcTextSize(button).x + 2 * style.FramePadding.x + style.ItemSpacing.x;
    return std::max(1.0F, ImGui::GetContentRegionAvail().x - (*button ? taken : 0));
}

inline void draw_coloured(const ImVec4& colour, std::string_view text) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    draw_text(text);
    ImGui::PopStyleColor();
}

// The panel at the left, with everything that can be set.

/// Draws the panel. Applies edits to the model and adds a command for each.
/// `bottom`: pixels at the bottom edge that the time bar takes.
void draw_controls(Model& model, const Surface& surface, float bottom, Commands& commands);

/// Draws a picture below all panels, as large as the window allows.
void draw_large(const PictureField& picture, const Surface& surface);

// The bar at the bottom: time, and the cost of a frame.

/// Draws the bar and returns its height in pixels.
float draw_time_bar(Model& model, const Surface& surface, Commands& commands);

// The panel at the bottom, with the errors of the scene.

struct ErrorLayout {
    ImFont* large;    ///< for the first error
    float bottom = 0; ///< pixels at the bottom edge that the time bar takes
};

void draw_errors(const Model& model, const Surface& surface, const ErrorLayout& layout, Commands& commands);

// The panel in the middle, with the effects of keys and mouse.

void draw_help(const Model& model, const Surface& surface, float bottom);

// Scenes to choose from, in the whole window.

void draw_gallery(const Model& model, const Surface& surface, Commands& commands);
/// Draws a picture without blending, from its upper left to its lower right corner on the screen.
void draw_opaque(ImDrawList& list, unsigned texture, ImVec2 from, ImVec2 to);

// The panel next to the pointer: the surrounding pixels, enlarged, and the values that passes wrote into the
// one under it.

void draw_magnifier(const MagnifierField& magnifier, const Surface& surface);

// The panel in the upper right corner: how long the current frame has taken, and its progress. Takes no
// events.

void draw_clock(const std::string& text, const Surface& surface);

// Lenses: the legend at the lower right, which takes no events, and the fields in the controls.

/// `bottom`: pixels at the bottom edge that other panels take.
void draw_legend(const LensField& lens, const Surface& surface, float bottom);
/// Draws the list of lenses and the hot lines.
void draw_lenses(Model& model, Commands& commands);
/// Draws the front of a knob in a panel at that corner, as far as it is in the window. It takes no events.
void draw_front(const FrontField& front, const Surface& surface, ImVec2 corner);

/// Draws the status line above `bottom` and returns its height in pixels. It takes no events.
float draw_status_line(const std::string& text, const Surface& surface, float bottom);

// Short messages at the upper right, below the clock. Take no events.

void draw_messages(const Model& model, const Surface& surface);

} // namespace tidemark::overlay
