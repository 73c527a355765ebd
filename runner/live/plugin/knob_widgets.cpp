#include "live/plugin/knob_widgets.hpp"

#include "live/plugin/text.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tidemark::live {
namespace {

/// Four digits: as precise as dragging by hand, and short in the file that values are written into.
constexpr const char* k_number = "%.4g";
constexpr const char* k_whole_number = "%.0f";

/// The widgets' share of a row's width; the name gets the rest.
constexpr float k_widget_share = 0.6F;

bool draw_check_box(KnobField& field) {
    const auto& [low, high] = *field.knob.range;
    bool on = field.value[0] == high[0];
    if (!ImGui::Checkbox("##value", &on))
        return false;
    field.value[0] = on ? high[0] : low[0];
    return true;
}

bool draw_colour(KnobField& field) {
    std::array<float, 3> colour{};
    std::copy_n(field.value.begin(), colour.size(), colour.begin());
    if (!ImGui::ColorEdit3("##value", colour.data(), ImGuiColorEditFlags_Float) ||
        !std::ranges::all_of(colour, [&](float part) { return takes(field.knob, part); }))
        return false;
    constexpr double k_steps = 1000; // as many digits as the widget shows
    std::ranges::transform(colour, field.value.begin(),
                           [](float part) { return std::round(double(part) * k_steps) / k_steps; });
    return true;
}

bool draw_component(KnobField& field, size_t i) {
    const char* format = info(field.knob.type).whole ? k_whole_number : k_number;
    double& value = field.value[i];
    const double before = value;
    const bool changed =
        widget_of(field.knob) == Widget::slider
            ? ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &field.knob.range->low[i],
                                  &field.knob.range->high[i], format)
            : ImGui::DragScalar("##value", ImGuiDataType_Double, &value, float(drag_speed(field.knob, i)),
                                nullptr, nullptr, format);
    if (changed)
        value = takes(field.knob, value) ? in_steps(field.knob, i, value) : before;
    return changed;
}

bool draw_components(KnobField& field) {
    const int count = info(field.knob.type).components;
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::CalcItemWidth() - gap * float(count - 1)) / float(count);
    bool changed = false;
    for (int i = 0; i < count; ++i) {
        if (i > 0)
            ImGui::SameLine(0, gap);
        ImGui::PushID(i);
        ImGui::SetNextItemWidth(width);
        changed |= draw_component(field, size_t(i));
        ImGui::PopID();
    }
    return changed;
}

bool draw_widget(KnobField& field) {
    switch (widget_of(field.knob)) {
    case Widget::check_box: return draw_check_box(field);
    case Widget::colour: return draw_colour(field);
    default: return draw_components(field);
    }
}

/// Draws the menu that a right click on the name opens.
void draw_controllers(const KnobField& field, Commands& commands) {
    if (field.controllers.empty() || !ImGui::BeginPopupContextItem("controllers"))
        return;
    for (size_t i = 0; i < field.controllers.size(); ++i) {
        const ControllerField& part = field.controllers[i];
        if (ImGui::MenuItem((shown(part.part) + ": move a controller").c_str(), nullptr, part.learning))
            commands.emplace_back(LearnController{field.knob.name, i});
        if (!part.controller.empty() &&
            ImGui::MenuItem(shown(part.part + ": forget " + part.controller).c_str()))
            commands.emplace_back(ForgetController{field.knob.name, i});
    }
    ImGui::EndPopup();
}

/// Draws the name, highlighted while one of its components waits for a controller.
void draw_name(const KnobField& field) {
    const ImVec4 bright{1, 0.8F, 0.2F, 1};
    if (std::ranges::any_of(field.controllers, &ControllerField::learning))
        draw_coloured(bright, field.knob.name);
    else
        draw_text(field.knob.name);
}

void draw_row(KnobField& field, Commands& commands) {
    ImGui::PushID(field.knob.name.c_str());
    if (draw_widget(field))
        commands.emplace_back(TurnKnob{field.knob.name, field.value});
    ImGui::SameLine();
    draw_name(field);
    draw_controllers(field, commands);
    if (field.is_turned()) {
        ImGui::SameLine();
        if (ImGui::SmallButton("reset")) {
            field.value = field.knob.initial;
            commands.emplace_back(ResetKnob{field.knob.name});
        }
    }
    ImGui::PopID();
}

} // namespace

void draw_knobs(std::vector<KnobField>& fields, Commands& commands) {
    if (fields.empty())
        return draw_wrapped("The scene has no knobs: it declares one with a line like\n"
                            "#iUniform float height = 0.5 in { 0.0, 2.0 }");
    if (ImGui::Button("Reset all"))
        commands.emplace_back(ResetKnobs{});
    ImGui::SameLine();
    if (ImGui::Button("Copy as --set"))
        commands.emplace_back(CopyKnobs{});
    ImGui::SameLine();
    if (ImGui::Button("Write to file"))
        commands.emplace_back(WriteKnobs{});
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * k_widget_share);
    for (KnobField& field : fields)
        draw_row(field, commands);
    ImGui::PopItemWidth();
}

} // namespace tidemark::live
