#include "live/plugin/magnifier_panel.hpp"

#include "live/plugin/text.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace tidemark::live {
namespace {

constexpr double k_cell = 12;

void draw_cells(const MagnifierField& magnifier, float cell) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const int columns = magnifier.cells.width, rows = magnifier.cells.height;
    const auto corner = [&](int column, int row) {
        return ImVec2(from.x + float(column) * cell, from.y + float(rows - row) * cell);
    };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            if (const auto& colour = magnifier.colours[size_t(row * columns + column)])
                list.AddRectFilled(corner(column, row + 1), corner(column + 1, row),
                                   IM_COL32((*colour)[0], (*colour)[1], (*colour)[2], 255));
    // Draw two frames, so that one is visible on any colour.
    const ImVec2 low = corner(columns / 2, rows / 2 + 1);
    const ImVec2 high = corner(columns / 2 + 1, rows / 2);
    list.AddRect({low.x - 1, low.y - 1}, {high.x + 1, high.y + 1}, IM_COL32_BLACK);
    list.AddRect(low, high, IM_COL32_WHITE);
    ImGui::Dummy({float(columns) * cell, float(rows) * cell});
}

void draw_value(const PixelValue& value, float column) {
    draw_text(value.pass);
    const auto row = [&](std::string (*text)(float)) {
        for (size_t i = 0; i < value.channels.size(); ++i) {
            if (i > 0)
                ImGui::SameLine(ImGui::GetStyle().WindowPadding.x + float(i) * column);
            ImGui::TextUnformatted(text(value.channels[i]).c_str());
        }
    };
    row(number_text);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    row(bits_text);
    ImGui::PopStyleColor();
}

/// Returns the panel's position: next to the pointer, on the side with room, within the window.
ImVec2 place_of(const MagnifierField& magnifier, const Surface& surface, ImVec2 size) {
    constexpr double k_away = 20;
    const auto away = float(k_away * surface.scale);
    const ImVec2 all(float(surface.extent.width), float(surface.extent.height));
    const ImVec2 pointer(float(magnifier.pointer.x), all.y - float(magnifier.pointer.y));
    const auto beside = [away](float at, float length, float end) {
        const float place = at + away + length <= end ? at + away : at - away - length;
        return std::clamp(place, 0.0F, std::max(0.0F, end - length));
    };
    return {beside(pointer.x, size.x, all.x), beside(pointer.y, size.y, all.y)};
}

} // namespace

void draw_magnifier(const MagnifierField& magnifier, const Surface& surface) {
    constexpr auto k_plain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                             ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing;
    const float column = ImGui::CalcTextSize("-1.234567e-05 ").x;
    if (ImGui::Begin("Magnifier", nullptr, k_plain)) {
        draw_cells(magnifier, float(k_cell * surface.scale));
        ImGui::TextUnformatted(fmt::format("pixel {},{}", magnifier.x, magnifier.y).c_str());
        for (const PixelValue& value : magnifier.values)
            draw_value(value, column);
        ImGui::SetWindowPos(place_of(magnifier, surface, ImGui::GetWindowSize()));
    }
    ImGui::End();
}

} // namespace tidemark::live
