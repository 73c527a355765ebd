#include "live/plugin/clock_panel.hpp"

#include "live/plugin/text.hpp"

#include <imgui.h>

namespace tidemark::live {

void draw_clock(const std::string& text, const Surface& surface) {
    const auto margin = float(8 * surface.scale);
    ImGui::SetNextWindowPos({float(surface.extent.width) - margin, margin}, ImGuiCond_Always, {1, 0});
    constexpr auto k_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                             ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing;
    if (ImGui::Begin("Clock", nullptr, k_flags))
        draw_text(text);
    ImGui::End();
}

} // namespace tidemark::live
