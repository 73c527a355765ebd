#include "live/plugin/view_widgets.hpp"

#include "live/plugin/text.hpp"

#include <imgui.h>

namespace tidemark::live {

void draw_views(const std::vector<std::string>& views, Commands& commands) {
    if (!ImGui::CollapsingHeader("Views"))
        return;
    if (ImGui::Button("Keep this moment"))
        commands.emplace_back(KeepView{});
    for (size_t i = 0; i < views.size(); ++i) {
        ImGui::PushID(int(i));
        if (ImGui::Button("x"))
            commands.emplace_back(ForgetView{i});
        ImGui::SameLine();
        if (ImGui::Button(shown(views[i]).c_str()))
            commands.emplace_back(GoToView{i});
        ImGui::PopID();
    }
}

} // namespace tidemark::live
