#include "window/plugin/imgui_drawing.hpp"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace tidemark::overlay {
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

/// The place of a scene in the gallery.
struct GalleryCell {
    float width;
    bool selected;
};

/// Draws a scene's thumbnail, or its error, above its name.
void draw_scene(const GalleryField& scene, size_t i, const GalleryCell& cell, Commands& commands) {
    constexpr float k_shape = 9 / 16.0F;
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const ImVec2 picture(cell.width, cell.width * k_shape);
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 to(from.x + picture.x, from.y + picture.y);
    ImGui::PushID(int(i));
    if (ImGui::InvisibleButton("scene", {picture.x, picture.y + line}))
        commands.emplace_back(OpenScene{i});
    const bool hovered = ImGui::IsItemHovered();
    if (hovered)
        ImGui::SetTooltip("%s", shown(scene.error.empty() ? scene.name : scene.error).c_str());
    ImGui::PopID();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(from, to, IM_COL32(32, 32, 32, 255));
    const auto text_in = [&](const std::string& text, const ImVec4& colour) {
        const ImVec4 clip(from.x, from.y, to.x, to.y);
        const float margin = ImGui::GetStyle().FramePadding.x;
        list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {from.x + margin, from.y + margin},
                     ImGui::GetColorU32(colour), text.c_str(), nullptr, picture.x - 2 * margin, &clip);
    };
    if (!scene.error.empty())
        text_in(shown(scene.error), k_red);
    else if (scene.texture == 0)
        text_in("…", k_grey);
    else
        draw_opaque(list, scene.texture, from, to);
    if (cell.selected || hovered)
        list.AddRect(from, to, cell.selected ? IM_COL32(255, 200, 60, 255) : IM_COL32(160, 160, 160, 255), 0,
                     0, cell.selected ? 3 : 1);
    const ImVec4 clip(from.x, to.y, to.x, to.y + line);
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {from.x, to.y + 1},
                 ImGui::GetColorU32(ImGuiCol_Text), shown(scene.name).c_str(), nullptr, 0, &clip);
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

ImU32 colour_of_bytes(const std::array<unsigned char, 3>& colour) {
    return IM_COL32(colour[0], colour[1], colour[2], 255);
}

/// Draws the bar of a legend, as wide as the panel, with its numbers below it.
void draw_bar(const LensField& lens, const Surface& surface, float width) {
    const auto height = float(12 * surface.scale);
    const ImVec2 from = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto count = float(lens.bar.size());
    for (size_t i = 0; i < lens.bar.size(); ++i)
        list.AddRectFilled({std::floor(from.x + width * float(i) / count), from.y},
                           {std::floor(from.x + width * float(i + 1) / count), from.y + height},
                           colour_of_bytes(lens.bar[i]));
    if (lens.mark) {
        const float x = from.x + width * float(*lens.mark);
        list.AddRect({x - 2, from.y - 1}, {x + 2, from.y + height + 1}, IM_COL32_BLACK);
        list.AddRect({x - 1, from.y - 1}, {x + 1, from.y + height + 1}, IM_COL32_WHITE);
    }
    ImGui::Dummy({width, height});
    draw_text(lens.low);
    ImGui::SameLine(ImGui::GetStyle().WindowPadding.x + width - ImGui::CalcTextSize(lens.high.c_str()).x);
    draw_text(lens.high);
}

/// Draws the entries of a legend in rows, a coloured box before each that has one.
void draw_entries(const LensField& lens, float width) {
    const float side = ImGui::GetFontSize() * 0.75F;
    float used = 0;
    for (const LegendField& entry : lens.entries) {
        const float gap = 2 * ImGui::GetStyle().ItemSpacing.x;
        const float length =
            ImGui::CalcTextSize(shown(entry.words).c_str()).x + (entry.box ? side + gap / 2 : 0);
        if (used > 0 && used + gap + length <= width) {
            ImGui::SameLine(0, gap);
            used += gap + length;
        } else {
            used = length;
        }
        if (entry.box) {
            const ImVec2 from = ImGui::GetCursorScreenPos();
            const float top = from.y + (ImGui::GetTextLineHeight() - side) / 2;
            ImDrawList& list = *ImGui::GetWindowDrawList();
            list.AddRectFilled({from.x, top}, {from.x + side, top + side}, colour_of_bytes(*entry.box));
            list.AddRect({from.x, top}, {from.x + side, top + side}, IM_COL32(165, 166, 170, 255));
            ImGui::Dummy({side, side});
            ImGui::SameLine(0, gap / 2);
        }
        if (length <= width)
            draw_text(entry.words);
        else
            draw_wrapped(entry.words);
    }
}

/// Draws a coloured text wrapped to the panel's width; nothing if it is empty.
void draw_wrapped_in(const ImVec4& colour, const std::string& text) {
    if (text.empty())
        return;
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    draw_wrapped(text);
    ImGui::PopStyleColor();
}

/// Draws a text field; returns whether the user has changed and left it.
bool draw_field(const char* label, std::string& text, float width) {
    constexpr size_t k_longest = 100;
    std::array<char, k_longest + 1> typed{};
    text.copy(typed.data(), k_longest);
    ImGui::SetNextItemWidth(width);
    if (ImGui::InputText(label, typed.data(), typed.size()))
        text = typed.data();
    return ImGui::IsItemDeactivatedAfterEdit();
}

/// Returns the lens as `--lens` takes it.
std::string lens_text(const LensChooser& lenses) {
    if (!lenses.chosen)
        return "";
    const LensChoice& choice = lenses.choices[*lenses.chosen];
    if (!choice.takes_line || lenses.place.empty())
        return choice.name;
    return choice.name + ":" + lenses.place +
           (choice.second.empty() || lenses.variable.empty() ? "" : ":" + lenses.variable);
}

/// Draws the list of lenses, and the line and the name for those that take them.
void draw_chooser(LensChooser& lenses, Commands& commands) {
    const float width = ImGui::GetContentRegionAvail().x * 0.6F;
    ImGui::SetNextItemWidth(width);
    bool changed = false;
    if (ImGui::BeginCombo("lens", lenses.chosen ? lenses.choices[*lenses.chosen].name.c_str() : "off")) {
        if (ImGui::Selectable("off", !lenses.chosen)) {
            lenses.chosen.reset();
            changed = true;
        }
        for (size_t i = 0; i < lenses.choices.size(); ++i) {
            const LensChoice& choice = lenses.choices[i];
            if (!choice.refusal.empty())
                ImGui::PushStyleColor(ImGuiCol_Text, k_grey);
            if (ImGui::Selectable(choice.name.c_str(), lenses.chosen == i)) {
                lenses.chosen = i;
                changed = true;
            }
            if (!choice.refusal.empty())
                ImGui::PopStyleColor();
            if (ImGui::IsItemHovered())
                ImGui::SetTooltip(
                    "%s", shown(choice.refusal.empty() ? choice.description : choice.refusal).c_str());
        }
        ImGui::EndCombo();
    }
    const LensChoice choice = lenses.chosen ? lenses.choices[*lenses.chosen] : LensChoice{};
    if (choice.takes_line)
        changed = draw_field("line", lenses.place, width) || changed;
    if (!choice.second.empty())
        changed = draw_field(choice.second.c_str(), lenses.variable, width) || changed;
    if (changed)
        commands.emplace_back(SetLens{lens_text(lenses)});
}

void draw_hot_lines(const HotLinesField& hot, Commands& commands) {
    const bool open = ImGui::CollapsingHeader("Hot lines");
    if (open != hot.open)
        commands.emplace_back(WatchHotLines{open});
    if (!open)
        return;
    if (hot.note.empty())
        draw_text("counting");
    for (size_t i = 0; i < hot.lines.size(); ++i) {
        const HotLineField& line = hot.lines[i];
        ImGui::PushID(int(i));
        draw_text(fmt::format("{:>6}", line.share_words));
        ImGui::SameLine();
        const std::string place = fmt::format("{}:{}", line.where.file, line.where.line);
        if (ImGui::SmallButton(shown(place).c_str()))
            commands.emplace_back(OpenEditor{line.where});
        ImGui::SameLine();
        draw_name_within(line.text, name_room(""));
        ImGui::PopID();
    }
    draw_wrapped(hot.note);
}

/// Draws a point for each value of the knob, the newest bright. Lower and further to the left is better.
void draw_points(const FrontField& front, const Surface& surface) {
    const ImVec2 size(ImGui::GetContentRegionAvail().x, float(90 * surface.scale));
    const ImVec2 from = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(from, {from.x + size.x, from.y + size.y}, IM_COL32(20, 21, 24, 255));
    double slowest = 0, worst = 0, least = 0;
    for (const FrontField::Point& point : front.points) {
        slowest = std::max(slowest, point.milliseconds);
        if (std::isfinite(point.error))
            worst = std::max(worst, point.error);
        if (point.error > 0)
            least = least > 0 ? std::min(least, point.error) : point.error;
    }
    const float pad = ImGui::GetFontSize();
    const double high = worst > 0 ? std::log10(worst) : 0, low = least > 0 ? std::log10(least) : high;
    const auto place = [&](const FrontField::Point& point) {
        const double x = slowest > 0 ? point.milliseconds / slowest : 0;
        const double y = !(point.error > 0) ? 0
                         : high > low       ? (std::log10(point.error) - low) / (high - low)
                                            : 0.5;
        return ImVec2(from.x + pad + float(x) * (size.x - 5 * pad),
                      from.y + size.y - pad - float(y) * (size.y - 2 * pad));
    };
    for (size_t i = 0; i < front.points.size(); ++i) {
        const FrontField::Point& point = front.points[i];
        const bool newest = i + 1 == front.points.size();
        const ImU32 colour = newest ? IM_COL32(255, 234, 70, 255) : IM_COL32(165, 166, 170, 255);
        if (i > 0)
            list.AddLine(place(front.points[i - 1]), place(point), IM_COL32(90, 92, 98, 255));
        if (std::isfinite(point.error))
            list.AddCircleFilled(place(point), float((newest ? 4 : 3) * surface.scale), colour);
        const ImVec2 at = place(point);
        list.AddText({at.x + pad / 2, at.y - pad / 2}, colour, shown(point.value).c_str());
    }
    ImGui::Dummy(size);
}

} // namespace

void draw_legend(const LensField& lens, const Surface& surface, float bottom) {
    const auto pixels = [&](double size) { return float(size * surface.scale); };
    const float margin = pixels(8);
    const ImVec2 corner(float(surface.extent.width) - margin, float(surface.extent.height) - bottom - margin);
    const float width = std::min(pixels(300), std::max(corner.x - 4 * margin, 1.0F));
    ImGui::SetNextWindowPos(corner, ImGuiCond_Always, {1, 1});
    ImGui::SetNextWindowSize({width + 2 * ImGui::GetStyle().WindowPadding.x, 0});
    constexpr auto k_flags = (k_bare_panel & ~ImGuiWindowFlags_AlwaysAutoResize) | ImGuiWindowFlags_NoInputs;
    if (ImGui::Begin("Lens", nullptr, k_flags)) {
        draw_wrapped(lens.title);
        draw_wrapped_in(k_red, lens.refusal);
        draw_wrapped_in(k_grey, lens.basis);
        if (!lens.bar.empty())
            draw_bar(lens, surface, width);
        draw_entries(lens, width);
        if (!lens.pointer.empty())
            draw_wrapped(lens.pointer);
        draw_wrapped_in(k_grey, lens.progress);
    }
    ImGui::End();
}

void draw_front(const FrontField& front, const Surface& surface, ImVec2 corner) {
    const auto pixels = [&](double size) { return float(size * surface.scale); };
    const ImVec2 size(pixels(260), pixels(150));
    const ImVec2 most(float(surface.extent.width) - size.x, float(surface.extent.height) - size.y);
    ImGui::SetNextWindowPos(
        {std::max(0.0F, std::min(corner.x, most.x)), std::max(0.0F, std::min(corner.y, most.y))});
    ImGui::SetNextWindowSize(size);
    constexpr auto k_flags = (k_bare_panel & ~ImGuiWindowFlags_AlwaysAutoResize) | ImGuiWindowFlags_NoInputs;
    if (ImGui::Begin("Front", nullptr, k_flags)) {
        draw_name_within(fmt::format("{}: error against time", front.knob), name_room(""));
        draw_points(front, surface);
        if (front.points.empty())
            draw_text("measuring");
        else
            draw_name_within(fmt::format("{}: {:.3g} ms, RMSE {:.3g}/255", front.points.back().value,
                                         front.points.back().milliseconds, front.points.back().error),
                             name_room(""));
    }
    ImGui::End();
}

void draw_lenses(Model& model, Commands& commands) {
    if (ImGui::CollapsingHeader("Lens"))
        draw_chooser(model.lenses, commands);
    draw_hot_lines(model.hot_lines, commands);
}

float draw_status_line(const std::string& text, const Surface& surface, float bottom) {
    const auto width = float(surface.extent.width);
    ImGui::SetNextWindowPos({0, float(surface.extent.height) - bottom}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSize({width, 0});
    constexpr auto k_flags = (k_bare_panel & ~ImGuiWindowFlags_AlwaysAutoResize) | ImGuiWindowFlags_NoInputs;
    ImGui::Begin("Status", nullptr, k_flags);
    draw_wrapped(text);
    const float height = ImGui::GetWindowHeight();
    ImGui::End();
    return height;
}

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

void draw_gallery(const Model& model, const Surface& surface, Commands& commands) {
    constexpr double k_preview_width = 160;
    const ImVec2 all(float(surface.extent.width), float(surface.extent.height));
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(all);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ImGui::SetNextWindowBgAlpha(1);
    constexpr auto k_flags =
        (ImGuiWindowFlags_NoDecoration & ~ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_NoMove;
    if (ImGui::Begin("Gallery", nullptr, k_flags)) {
        draw_wrapped("Arrows and Enter, or a click, open a scene; in it Backspace comes back, PageUp and "
                     "PageDown open the next one.");
        const float gap = ImGui::GetStyle().ItemSpacing.x;
        const float room = ImGui::GetContentRegionAvail().x;
        const auto columns =
            size_t(std::max(1.0F, std::round((room + gap) / (float(k_preview_width * surface.scale) + gap))));
        const float width = (room - gap * float(columns - 1)) / float(columns);
        ImGuiStorage& kept = *ImGui::GetStateStorage();
        if (kept.GetInt(ImGui::GetID("columns")) != int(columns))
            commands.emplace_back(GalleryColumns{columns});
        kept.SetInt(ImGui::GetID("columns"), int(columns));
        const bool moved = kept.GetInt(ImGui::GetID("selected")) != int(model.selected);
        kept.SetInt(ImGui::GetID("selected"), int(model.selected));
        for (size_t i = 0; i < model.gallery.size(); ++i) {
            if (i % columns > 0)
                ImGui::SameLine();
            draw_scene(model.gallery[i], i, {width, i == model.selected}, commands);
            if (moved && i == model.selected)
                ImGui::SetScrollHereY();
        }
    }
    ImGui::End();
    ImGui::PopStyleVar();
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

} // namespace tidemark::overlay
