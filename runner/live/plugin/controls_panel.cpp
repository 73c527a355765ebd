#include "live/plugin/controls_panel.hpp"

#include "live/plugin/definition_widgets.hpp"
#include "live/plugin/knob_widgets.hpp"
#include "live/plugin/picture_widgets.hpp"
#include "live/plugin/view_widgets.hpp"

#include <imgui.h>

namespace tidemark::live {

void draw_controls(Model& model, const Surface& surface, Commands& commands) {
    constexpr double k_margin = 8;
    constexpr double k_width = 320;
    const auto pixels = [&](double size) { return float(size * surface.scale); };
    ImGui::SetNextWindowPos({pixels(k_margin), pixels(k_margin)}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints(
        {pixels(k_width), 0}, {pixels(k_width), float(surface.extent.height) - 2 * pixels(k_margin)});
    if (ImGui::Begin("Controls", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
        draw_knobs(model.knobs, commands);
        draw_definitions(model.definitions, commands);
        draw_thumbnails(model, surface, commands);
        draw_views(model.views, commands);
    }
    ImGui::End();
}

} // namespace tidemark::live
