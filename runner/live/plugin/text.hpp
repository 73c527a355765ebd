// Text that came from people or their files, as panels show it: cut where no screen could hold it. Dear ImGui
// takes 16,384 characters in one call and ends the program at more.
#pragma once

#include "base/printable.hpp"

#include <imgui.h>

#include <string>
#include <string_view>

namespace tidemark::live {

/// The text as a label or a line: 2,000 bytes of it at most.
inline std::string shown(std::string_view text) {
    constexpr size_t k_most_bytes = 2000;
    return cut_text(text, k_most_bytes);
}

inline void draw_text(std::string_view text) {
    ImGui::TextUnformatted(shown(text).c_str());
}

/// In as many lines as the panel's width asks for.
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
