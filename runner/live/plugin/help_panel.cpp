#include "live/plugin/help_panel.hpp"

#include <imgui.h>

namespace tidemark::live {

void draw_help(const Model& model, const Surface& surface) {
    const ImVec2 all(float(surface.extent.width), float(surface.extent.height));
    ImGui::SetNextWindowPos({all.x / 2, all.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSizeConstraints({0, 0}, all);
    constexpr auto k_plain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                             ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing;
    if (ImGui::Begin("Help", nullptr, k_plain & ~ImGuiWindowFlags_NoScrollbar)) {
        if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
            for (const HelpRow& row : model.help) {
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(row.keys.c_str());
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(row.meaning.c_str());
            }
            ImGui::EndTable();
        }
        ImGui::TextUnformatted(model.help_footer.c_str());
    }
    ImGui::End();
}

} // namespace tidemark::live
