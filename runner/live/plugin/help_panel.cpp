#include "live/plugin/help_panel.hpp"

#include "live/plugin/text.hpp"

#include <imgui.h>

#include <algorithm>

namespace tidemark::live {

void draw_help(const Model& model, const Surface& surface) {
    constexpr double k_width = 620; // the longest row takes two lines
    const ImVec2 all(float(surface.extent.width), float(surface.extent.height));
    ImGui::SetNextWindowPos({all.x / 2, all.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
    const float width = std::min(all.x, float(k_width * surface.scale));
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, all.y});
    constexpr auto k_plain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                             ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing;
    if (ImGui::Begin("Help", nullptr, k_plain & ~ImGuiWindowFlags_NoScrollbar)) {
        if (ImGui::BeginTable("keys", 2)) {
            ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed);
            ImGui::TableSetupColumn("meaning", ImGuiTableColumnFlags_WidthStretch);
            for (const HelpRow& row : model.help) {
                ImGui::TableNextColumn();
                draw_text(row.keys);
                ImGui::TableNextColumn();
                draw_wrapped(row.meaning);
            }
            ImGui::EndTable();
        }
        draw_wrapped(model.help_footer);
    }
    ImGui::End();
}

} // namespace tidemark::live
