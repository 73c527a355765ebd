#include "live/plugin/definition_widgets.hpp"

#include "live/plugin/text.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace tidemark::live {
namespace {

/// Draws one field. A value is sent only when editing it ends, because each one is compiled.
void draw_row(DefinitionField& field, Commands& commands) {
    constexpr double k_share = 0.005;
    constexpr float k_whole_speed = 0.1F;
    const float speed = field.whole ? k_whole_speed : float(k_share * std::max(std::abs(field.value), 1.0));
    ImGui::PushID(field.name.c_str());
    if (ImGui::DragScalar("##value", ImGuiDataType_Double, &field.value, speed, nullptr, nullptr,
                          field.whole ? "%.0f" : "%.4g"))
        field.changing = true;
    if (field.changing && !ImGui::IsItemActive()) {
        field.changing = false;
        if (std::isfinite(field.value))
            commands.emplace_back(Define{field.name, text_of(field)});
    }
    ImGui::SameLine();
    draw_text(field.name);
    if (field.held) {
        ImGui::SameLine();
        if (ImGui::SmallButton("reset"))
            commands.emplace_back(Undefine{field.name});
    }
    ImGui::PopID();
}

} // namespace

void draw_definitions(std::vector<DefinitionField>& fields, Commands& commands) {
    constexpr float k_widget_share = 0.6F;
    if (fields.empty() || !ImGui::CollapsingHeader("Definitions"))
        return;
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * k_widget_share);
    for (DefinitionField& field : fields)
        draw_row(field, commands);
    ImGui::PopItemWidth();
}

} // namespace tidemark::live
