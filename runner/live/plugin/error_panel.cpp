#include "live/plugin/error_panel.hpp"

#include "live/plugin/text.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace tidemark::live {
namespace {

const ImVec4 k_red{1, 0.45F, 0.4F, 1};
const ImVec4 k_grey{0.7F, 0.7F, 0.7F, 1};

/// Draws the place as a link, the source line, and a mark under the column.
void draw_place(const ErrorField& error, Commands& commands) {
    const SourceLocation& where = error.diagnostic.where;
    if (where.file.empty())
        return;
    std::string place = where.file;
    for (const int number : {where.line, where.column})
        if (number > 0)
            place += fmt::format(":{}", number);
    if (ImGui::SmallButton(shown(place).c_str()))
        commands.emplace_back(OpenEditor{where});
    if (error.line.empty())
        return;
    const float character = ImGui::CalcTextSize("m").x;
    const Excerpt excerpt = excerpt_of(error.line, where.column,
                                       size_t(std::max(ImGui::GetContentRegionAvail().x / character, 1.0F)));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    draw_text(excerpt.text);
    draw_coloured(k_red, excerpt.mark);
    ImGui::PopStyleVar();
}

void draw_first(const ErrorField& error, ImFont* large, Commands& commands) {
    ImGui::PushFont(large);
    ImGui::PushStyleColor(ImGuiCol_Text, k_red);
    draw_wrapped(error.diagnostic.message);
    ImGui::PopStyleColor();
    ImGui::PopFont();
    draw_place(error, commands);
}

void draw_others(const std::vector<ErrorField>& errors, Commands& commands) {
    if (errors.size() < 2 || !ImGui::TreeNode("more", "%zu more", errors.size() - 1))
        return;
    for (size_t i = 1; i < errors.size(); ++i) {
        ImGui::PushID(int(i));
        ImGui::PushStyleColor(ImGuiCol_Text,
                              errors[i].diagnostic.severity == Severity::error ? k_red : k_grey);
        draw_wrapped(errors[i].diagnostic.message);
        ImGui::PopStyleColor();
        draw_place(errors[i], commands);
        ImGui::PopID();
    }
    ImGui::TreePop();
}

} // namespace

void draw_errors(const Model& model, const Surface& surface, const ErrorLayout& layout, Commands& commands) {
    constexpr double k_margin = 8;
    const auto margin = float(k_margin * surface.scale);
    const auto width = float(surface.extent.width) - 2 * margin;
    const auto bottom = float(surface.extent.height) - layout.bottom - margin;
    ImGui::SetNextWindowPos({margin, bottom}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, bottom - margin});
    constexpr auto k_plain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                             ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing;
    if (ImGui::Begin("Errors", nullptr, k_plain & ~ImGuiWindowFlags_NoScrollbar)) {
        draw_first(model.errors.front(), layout.large, commands);
        draw_others(model.errors, commands);
    }
    ImGui::End();
}

} // namespace tidemark::live
