// Draws text from users or their files, cut to a length that any screen can show. Dear ImGui aborts the
// program at more than 16,384 characters in one call.
#pragma once

#include "base/printable.hpp"

#include <imgui.h>

#include <string>
#include <string_view>

namespace tidemark::live {

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

inline void draw_coloured(const ImVec4& colour, std::string_view text) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    draw_text(text);
    ImGui::PopStyleColor();
}

} // namespace tidemark::live
