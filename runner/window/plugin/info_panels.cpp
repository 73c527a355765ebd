#include "window/plugin/imgui_drawing.hpp"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

namespace tidemark::live {
namespace {

constexpr auto k_scrolled_panel = (k_bare_panel | ImGuiWindowFlags_NoMove) & ~ImGuiWindowFlags_NoScrollbar;

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
    const auto more = std::count_if(errors.begin() + 1, errors.end(),
                                    [](const ErrorField& error) { return !error.summary; });
    if (more == 0 || !ImGui::TreeNode("more", "%d more", int(more)))
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

void draw_errors(const Model& model, const Surface& surface, const ErrorLayout& layout, Commands& commands) {
    constexpr double k_margin = 8;
    const auto margin = float(k_margin * surface.scale);
    const auto width = float(surface.extent.width) - 2 * margin;
    const auto bottom = float(surface.extent.height) - layout.bottom - margin;
    ImGui::SetNextWindowPos({margin, bottom}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, bottom - margin});
    if (ImGui::Begin("Errors", nullptr, k_scrolled_panel)) {
        draw_first(model.errors.front(), layout.large, commands);
        draw_others(model.errors, commands);
    }
    ImGui::End();
}

void draw_help(const Model& model, const Surface& surface, float bottom) {
    constexpr double k_width = 620; // the longest row takes two lines
    const ImVec2 all(float(surface.extent.width), float(surface.extent.height) - bottom);
    ImGui::SetNextWindowPos({all.x / 2, all.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
    const float width = std::min(all.x, float(k_width * surface.scale));
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, all.y});
    ImGui::SetNextWindowBgAlpha(1);
    if (ImGui::Begin("Help", nullptr, k_scrolled_panel)) {
        ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
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

void draw_magnifier(const MagnifierField& magnifier, const Surface& surface) {
    const float column = ImGui::CalcTextSize("-1.234567e-05 ").x;
    if (ImGui::Begin("Magnifier", nullptr, k_bare_panel | ImGuiWindowFlags_NoInputs)) {
        draw_cells(magnifier, float(k_cell * surface.scale));
        ImGui::TextUnformatted(fmt::format("pixel {},{}", magnifier.x, magnifier.y).c_str());
        for (const PixelValue& value : magnifier.values)
            draw_value(value, column);
        ImGui::SetWindowPos(place_of(magnifier, surface, ImGui::GetWindowSize()));
    }
    ImGui::End();
}

void draw_clock(const std::string& text, const Surface& surface) {
    const auto margin = float(8 * surface.scale);
    ImGui::SetNextWindowPos({float(surface.extent.width) - margin, margin}, ImGuiCond_Always, {1, 0});
    if (ImGui::Begin("Clock", nullptr, k_bare_panel | ImGuiWindowFlags_NoInputs))
        draw_text(text);
    ImGui::End();
}

void draw_messages(const Model& model, const Surface& surface) {
    const auto pixels = [&](double size) { return float(size * surface.scale); };
    const float margin = pixels(8), padding = pixels(6);
    const float right = float(surface.extent.width) - margin;
    const float most = std::max(right - margin - 2 * padding, 1.0F);
    float top = margin + (model.clock.empty() ? 0 : ImGui::GetFrameHeight() + 2 * margin);
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    for (const MessageField& message : model.messages) {
        const std::string text = shown(message.text);
        const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, most);
        const ImVec2 from(right - size.x - 2 * padding, top), to(right, top + size.y + 2 * padding);
        const auto alpha = [&](double share) { return int(255 * share * message.opacity); };
        list.AddRectFilled(from, to, IM_COL32(0, 0, 0, alpha(0.8)), pixels(3));
        list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {from.x + padding, from.y + padding},
                     IM_COL32(255, 255, 255, alpha(1)), text.c_str(), nullptr, most);
        top = to.y + padding;
    }
}

} // namespace tidemark::live
