#include "live/plugin/look_widgets.hpp"

#include <imgui.h>

#include <algorithm>

namespace tidemark::live {
namespace {

bool draw_channels(LookField& look) {
    bool changed = false;
    if (!ImGui::BeginCombo("channels", k_channel_choices[look.channels].name.data()))
        return changed;
    for (size_t i = 0; i < k_channel_choices.size(); ++i)
        if (ImGui::Selectable(k_channel_choices[i].name.data(), i == look.channels)) {
            look.channels = i;
            changed = true;
        }
    ImGui::EndCombo();
    return changed;
}

/// Draws the exposure slider. Moving it turns automatic exposure off.
bool draw_exposure(LookField& look) {
    auto stops = float(look.stops);
    const bool turned = ImGui::SliderFloat("exposure", &stops, -float(k_most_stops), float(k_most_stops),
                                           look.automatic ? "auto: %+.2f stops" : "%+.2f stops");
    if (turned) {
        look.stops = stops;
        look.automatic = false;
    }
    return ImGui::Checkbox("auto", &look.automatic) || turned;
}

bool draw_slice(LookField& look, int slices) {
    if (slices <= 1)
        return false;
    int slice = std::clamp(look.slice.value_or(slices / 2), 0, slices - 1);
    const bool turned = ImGui::SliderInt("slice", &slice, 0, slices - 1);
    if (turned)
        look.slice = slice;
    return turned;
}

} // namespace

void draw_look(const Model& model, Commands& commands) {
    if (!model.large)
        return;
    LookField look = model.look;
    bool changed = draw_channels(look);
    changed = draw_exposure(look) || changed;
    ImGui::SameLine();
    if (ImGui::Button("as it is")) {
        look = {.slice = look.slice};
        changed = true;
    }
    changed = draw_slice(look, model.pictures[*model.large].slices) || changed;
    if (changed)
        commands.emplace_back(LookAtPicture{look});
}

} // namespace tidemark::live
