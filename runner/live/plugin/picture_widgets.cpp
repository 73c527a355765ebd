#include "live/plugin/picture_widgets.hpp"

#include "live/plugin/look_widgets.hpp"
#include "live/plugin/text.hpp"

#include <GL/gl.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace tidemark::live {
namespace {

ImTextureID texture_of(const PictureField& picture) {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): Dear ImGui has names travel as pointers.
    return reinterpret_cast<ImTextureID>(uintptr_t(picture.texture));
}

/// Draws without blending, since a buffer's alpha is not transparency.
void draw_opaque(ImDrawList& list, const PictureField& picture, ImVec2 from, ImVec2 to) {
    list.AddCallback([](const ImDrawList*, const ImDrawCmd*) { glDisable(GL_BLEND); }, nullptr);
    list.AddImage(texture_of(picture), from, to, {0, 1}, {1, 0}); // OpenGL's rows begin at the bottom
    list.AddCallback(ImDrawCallback_ResetRenderState, nullptr);
}

float shape_of(const PictureField& picture) {
    return float(std::max(picture.extent.width, 1)) / float(std::max(picture.extent.height, 1));
}

void draw_thumbnail(const Model& model, size_t i, float width, Commands& commands) {
    const PictureField& picture = model.pictures[i];
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size(width, std::clamp(width / shape_of(picture), width / 4, width));
    ImGui::PushID(int(i));
    if (ImGui::InvisibleButton("picture", size))
        commands.emplace_back(ShowPicture{model.large == i ? std::nullopt : std::optional(i)});
    ImGui::PopID();
    draw_opaque(*ImGui::GetWindowDrawList(), picture, from, {from.x + size.x, from.y + size.y});
    ImGui::SameLine();
    draw_text(fmt::format("{} {}\n{}", i + 1, picture.name, picture.size));
}

} // namespace

void draw_thumbnails(const Model& model, const Surface& surface, Commands& commands) {
    constexpr double k_width = 120;
    if (model.pictures.empty() || !ImGui::CollapsingHeader("Passes and inputs"))
        return;
    for (size_t i = 0; i < model.pictures.size(); ++i)
        draw_thumbnail(model, i, float(k_width * surface.scale), commands);
    draw_look(model, commands);
}

void draw_large(const PictureField& picture, const Surface& surface) {
    const ImVec2 all(float(surface.extent.width), float(surface.extent.height));
    const float width = std::min(all.x, all.y * shape_of(picture));
    const ImVec2 size(width, width / shape_of(picture));
    const ImVec2 from((all.x - size.x) / 2, (all.y - size.y) / 2);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({0, 0}, all, IM_COL32_BLACK);
    draw_opaque(list, picture, from, {from.x + size.x, from.y + size.y});
}

} // namespace tidemark::live
