// Fields for the numbers that a scene defines.

#include "host/overlay_fields.hpp"
#include "host/overlay_model.hpp"
#include "window/plugin/imgui_drawing.hpp"
#include "window/plugin/panels.hpp"

#include <backends/imgui_impl_opengl3_loader.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::overlay {
namespace {

/// The widgets' share of a row's width; the name gets the rest.
constexpr float k_widget_share = 0.6F;

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
    draw_name_within(field.name, name_room(field.held ? "reset" : ""));
    if (field.held) {
        ImGui::SameLine();
        if (ImGui::SmallButton("reset"))
            commands.emplace_back(Undefine{field.name});
    }
    ImGui::PopID();
}

void draw_definitions(std::vector<DefinitionField>& fields, Commands& commands) {
    if (fields.empty() || !ImGui::CollapsingHeader("Definitions"))
        return;
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * k_widget_share);
    for (DefinitionField& field : fields)
        draw_row(field, commands);
    ImGui::PopItemWidth();
}

// Widgets for the knobs of a scene.

/// Four digits: as precise as dragging by hand, and short in the file that values are written into.
constexpr const char* k_number = "%.4g";
constexpr const char* k_whole_number = "%.0f";

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
    const bool learning = std::ranges::any_of(field.controllers, &ControllerField::learning);
    if (learning)
        ImGui::PushStyleColor(ImGuiCol_Text, bright);
    draw_name_within(field.knob.name, name_room(field.is_turned() ? "reset" : ""));
    if (learning)
        ImGui::PopStyleColor();
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

/// Puts the next button into the same row if it fits.
void stay_in_row(const char* button) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float needed = style.ItemSpacing.x + ImGui::CalcTextSize(button).x + 2 * style.FramePadding.x;
    if (ImGui::GetItemRectMax().x + needed <= ImGui::GetWindowPos().x + ImGui::GetContentRegionMax().x)
        ImGui::SameLine();
}

/// Draws the knobs. Returns the upper end of the row of the knob of that name; nothing: there is none.
std::optional<float> draw_knobs(std::vector<KnobField>& fields, const std::string& name, Commands& commands) {
    std::optional<float> found;
    if (fields.empty()) {
        draw_wrapped("The scene has no knobs: it declares one with a line like\n"
                     "#iUniform float height = 0.5 in { 0, 2 }");
        return found;
    }
    if (ImGui::Button("Reset all"))
        commands.emplace_back(ResetKnobs{});
    stay_in_row("Copy as --set");
    if (ImGui::Button("Copy as --set"))
        commands.emplace_back(CopyKnobs{});
    stay_in_row("Write to file");
    if (ImGui::Button("Write to file"))
        commands.emplace_back(WriteKnobs{});
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * k_widget_share);
    for (KnobField& field : fields) {
        if (field.knob.name == name)
            found = ImGui::GetCursorScreenPos().y;
        draw_row(field, commands);
    }
    ImGui::PopItemWidth();
    return found;
}

// The list of views that the user kept.

/// Draws a view's name as a field. A new name counts when the field is left.
void draw_view_name(ViewField& view, size_t i, Commands& commands) {
    constexpr size_t k_longest = 200;
    std::array<char, k_longest + 1> text{};
    view.name.copy(text.data(), k_longest);
    const float button = ImGui::CalcTextSize("x").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SetNextItemWidth(
        std::max(ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x, 1.0F));
    ImGui::InputText("##name", text.data(), text.size());
    if (ImGui::IsItemEdited())
        view.name = text.data();
    if (ImGui::IsItemDeactivatedAfterEdit())
        commands.emplace_back(RenameView{i, text.data()});
    ImGui::SameLine();
    if (ImGui::Button("x"))
        commands.emplace_back(ForgetView{i});
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("Forget this view");
}

/// Draws a view: its thumbnail, which goes to it, and beside it its name and what it holds.
void draw_view(ViewField& view, size_t i, const Surface& surface, Commands& commands) {
    constexpr double k_width = 80, k_height = 45;
    const ImVec2 size(float(k_width * surface.scale), float(k_height * surface.scale));
    const ImVec2 from = ImGui::GetCursorScreenPos();
    ImGui::PushID(int(i));
    const bool chosen = view.texture == 0 ? ImGui::Button("go", size) : ImGui::InvisibleButton("go", size);
    if (chosen)
        commands.emplace_back(GoToView{i});
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip(i < 9 ? "Go to this view (Alt+%zu)" : "Go to this view", i + 1);
    if (view.texture != 0) {
        const float share = std::min(size.x / float(std::max(view.extent.width, 1)),
                                     size.y / float(std::max(view.extent.height, 1)));
        const ImVec2 drawn(float(view.extent.width) * share, float(view.extent.height) * share);
        const ImVec2 corner(from.x + (size.x - drawn.x) / 2, from.y + (size.y - drawn.y) / 2);
        draw_opaque(*ImGui::GetWindowDrawList(), view.texture, corner,
                    {corner.x + drawn.x, corner.y + drawn.y});
    }
    ImGui::SameLine();
    ImGui::BeginGroup();
    draw_view_name(view, i, commands);
    draw_name_within(view.label, name_room(""));
    ImGui::EndGroup();
    ImGui::PopID();
}

void draw_views(Model& model, const Surface& surface, Commands& commands) {
    constexpr double k_begin = 0, k_longest = 60;
    if (!ImGui::CollapsingHeader("Views"))
        return;
    if (ImGui::Button("Keep this moment"))
        commands.emplace_back(KeepView{});
    stay_in_row("over 00.0 s");
    ImGui::SetNextItemWidth(ImGui::CalcTextSize("over 00.0 s").x + 2 * ImGui::GetStyle().FramePadding.x);
    if (ImGui::DragScalar("##morph", ImGuiDataType_Double, &model.morph_seconds, 0.05F, &k_begin, &k_longest,
                          model.morph_seconds > 0 ? "over %.1f s" : "at once"))
        commands.emplace_back(SetMorph{std::clamp(model.morph_seconds, k_begin, k_longest)});
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("How long going to a view takes; drag, or Ctrl-click to type seconds.\n"
                          "Over some time, iTime runs on.");
    for (size_t i = 0; i < model.views.size(); ++i)
        draw_view(model.views[i], i, surface, commands);
}

// Fields below the thumbnails: how the large picture is viewed.

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

/// Draws nothing if no picture is large.
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

/// Draws nothing for a scene without sound.
void draw_sound(std::optional<SoundField>& sound, Commands& commands) {
    constexpr float k_percent = 100;
    if (!sound)
        return;
    auto volume = float(sound->volume) * k_percent;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x * k_widget_share);
    bool changed = ImGui::SliderFloat("##volume", &volume, 0, k_percent, "volume %.0f %%");
    if (changed)
        *sound = {std::clamp(double(volume / k_percent), 0.0, 1.0), false};
    ImGui::SameLine();
    changed = ImGui::Checkbox("mute", &sound->muted) || changed;
    if (changed)
        commands.emplace_back(SetVolume{*sound});
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
    draw_opaque(*ImGui::GetWindowDrawList(), picture.texture, from, {from.x + size.x, from.y + size.y});
    ImGui::SameLine();
    draw_text(fmt::format("{} {}\n{}", i + 1, picture.name, picture.size));
}

void draw_thumbnails(const Model& model, const Surface& surface, Commands& commands) {
    constexpr double k_width = 120;
    if (model.pictures.empty() || !ImGui::CollapsingHeader("Passes and inputs"))
        return;
    for (size_t i = 0; i < model.pictures.size(); ++i)
        draw_thumbnail(model, i, float(k_width * surface.scale), commands);
    draw_look(model, commands);
}

void draw_stepping(const TimeField& time, Commands& commands) {
    const Stepping& stepping = *time.stepping;
    if (time.bar_held) // the slider is not there to be released
        commands.emplace_back(HoldBar{false});
    const std::string text = fmt::format("frame {} of {}", stepping.frame, stepping.last);
    if (ImGui::Button("Cancel"))
        commands.emplace_back(GiveUpSeek{});
    ImGui::SameLine();
    ImGui::ProgressBar(float(stepping.frame) / float(std::max(stepping.last, 1)), {-1, 0}, text.c_str());
}

void draw_loop(TimeField& time, Commands& commands) {
    const auto set = [&](std::optional<double> from, std::optional<double> to) {
        time.loop_from = from;
        time.loop_to = to;
        commands.emplace_back(SetLoop{from, to});
    };
    if (ImGui::Button("A"))
        set(time.seconds, time.loop_to);
    ImGui::SameLine();
    if (ImGui::Button("B"))
        set(time.loop_from, time.seconds);
    if (!time.loop_from && !time.loop_to)
        return;
    ImGui::SameLine();
    const auto text = [](const std::optional<double>& end) {
        return end ? fmt::format("{:.2f}", *end) : "?";
    };
    if (ImGui::Button(fmt::format("{} - {} x", text(time.loop_from), text(time.loop_to)).c_str()))
        set(std::nullopt, std::nullopt);
}

void draw_speed(TimeField& time, Commands& commands) {
    constexpr double k_fastest = 4;
    const double slowest = time.turns_back ? -k_fastest : 0;
    ImGui::SetNextItemWidth(ImGui::CalcTextSize("x -0.00").x * 2);
    if (ImGui::SliderScalar("##speed", ImGuiDataType_Double, &time.speed, &slowest, &k_fastest, "x %.2f"))
        commands.emplace_back(SetSpeed{time.speed});
}

/// Draws the time slider. A typed number takes effect when the field is left, because seeking at its first
/// digit would replace the bar; Escape discards it. Dragging seeks at once. After the Ctrl-click that opens
/// the field the button is still down for a while and the time changes, which must not count as a drag.
void draw_scrubber(TimeField& time, Commands& commands) {
    constexpr double k_begin = 0;
    constexpr float k_nothing = -1;
    const double end = time.bar_end;
    const float button = ImGui::CalcTextSize("00000 s").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    const ImGuiID typed = ImGui::GetID("typed time");
    ImGui::SetNextItemWidth(-button - ImGui::GetStyle().ItemSpacing.x);
    const bool moved =
        ImGui::SliderScalar("##time", ImGuiDataType_Double, &time.seconds, &k_begin, &end, "%.2f s");
    const bool released = ImGui::IsItemDeactivated();
    if (ImGui::IsItemActivated())
        commands.emplace_back(HoldBar{true});
    if (moved) {
        const double wanted = std::max(time.seconds, 0.0);
        if (ImGui::IsMouseDown(ImGuiMouseButton_Left) && !ImGui::GetIO().WantTextInput)
            commands.emplace_back(Seek{wanted});
        else
            kept.SetFloat(typed, float(wanted));
    }
    ImGui::SameLine();
    if (ImGui::Button(fmt::format("{:.0f} s###end", end).c_str(), {button, 0})) {
        commands.emplace_back(GrowBar{});
        time.bar_end *= 2; // a second click before the next frame goes by the new end
    }
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("The bar's end; click to double it");
    if (!released)
        return;
    commands.emplace_back(HoldBar{false});
    const bool taken_back = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
    if (const float wanted = kept.GetFloat(typed, k_nothing); wanted >= 0 && !taken_back)
        commands.emplace_back(Seek{wanted});
    kept.SetFloat(typed, k_nothing);
}

void draw_clock(TimeField& time, const Surface& surface, Commands& commands) {
    constexpr double k_one_row = 380; // a narrower window has the slider in a row of its own
    if (ImGui::Button("|<"))
        commands.emplace_back(Restart{});
    ImGui::SameLine();
    if (ImGui::Button(time.paused ? "Play###pause" : "Pause###pause"))
        commands.emplace_back(TogglePause{});
    ImGui::SameLine();
    draw_loop(time, commands);
    ImGui::SameLine();
    if (time.has_speed)
        draw_speed(time, commands);
    if (ImGui::GetWindowWidth() >= float(k_one_row * surface.scale))
        ImGui::SameLine();
    draw_scrubber(time, commands);
}

void draw_status(const Model& model) {
    std::string text = fmt::format("{:.3f} s  frame {}  {}x{}", model.time.seconds, model.time.frame,
                                   model.extent.width, model.extent.height);
    if (model.time.frame_rate > 0)
        text += fmt::format("  {:.0f} fps", model.time.frame_rate);
    double total = 0;
    for (const PictureField& picture : model.pictures)
        if (picture.milliseconds) {
            text += fmt::format("  {} {:.2f} ms", picture.name, *picture.milliseconds);
            total += *picture.milliseconds;
        }
    text += fmt::format("  all {:.2f} ms", total);
    draw_text(text);
}

} // namespace

/// Draws without blending, since a buffer's alpha is not transparency.
void draw_opaque(ImDrawList& list, unsigned texture, ImVec2 from, ImVec2 to) {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): Dear ImGui has names travel as pointers.
    const auto id = reinterpret_cast<ImTextureID>(uintptr_t(texture));
    list.AddCallback([](const ImDrawList*, const ImDrawCmd*) { glDisable(GL_BLEND); }, nullptr);
    list.AddImage(id, from, to, {0, 1}, {1, 0}); // OpenGL's rows begin at the bottom
    list.AddCallback(ImDrawCallback_ResetRenderState, nullptr);
}

void draw_large(const PictureField& picture, const Surface& surface) {
    const ImVec2 all(float(surface.extent.width), float(surface.extent.height));
    const float width = std::min(all.x, all.y * shape_of(picture));
    const ImVec2 size(width, width / shape_of(picture));
    const ImVec2 from((all.x - size.x) / 2, (all.y - size.y) / 2);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({0, 0}, all, IM_COL32_BLACK);
    draw_opaque(list, picture.texture, from, {from.x + size.x, from.y + size.y});
}

void draw_controls(Model& model, const Surface& surface, float bottom, Commands& commands) {
    constexpr double k_margin = 8;
    constexpr double k_width = 320;
    constexpr double k_narrowest = 160;
    constexpr float k_share = 0.8F; // of a narrow window
    const auto pixels = [&](double size) { return float(size * surface.scale); };
    const float margin = pixels(k_margin);
    const ImVec2 all(float(surface.extent.width), float(surface.extent.height) - bottom);
    const ImVec2 most(std::max(all.x - 2 * margin, 1.0F), std::max(all.y - 2 * margin, 1.0F));
    const ImGuiWindow* const before = ImGui::FindWindowByName("Controls");
    const float first = std::min(pixels(k_width), all.x * k_share);
    const float width = before && !before->Collapsed ? before->SizeFull.x : first;
    ImGui::SetNextWindowPos({margin, margin}, ImGuiCond_FirstUseEver);
    // The height follows the contents; the user may drag the right edge.
    ImGui::SetNextWindowSize({width, 0});
    ImGui::SetNextWindowSizeConstraints({std::min(pixels(k_narrowest), most.x), 0}, most);
    const bool open = ImGui::Begin("Controls");
    const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    const ImVec2 within(std::clamp(at.x, 0.0F, std::max(0.0F, all.x - size.x)),
                        std::clamp(at.y, 0.0F, std::max(0.0F, all.y - size.y)));
    if (within.x != at.x || within.y != at.y)
        ImGui::SetWindowPos(within);
    std::optional<float> row; // of the knob whose front is shown
    if (open) {
        row = draw_knobs(model.knobs, model.front ? model.front->knob : "", commands);
        draw_definitions(model.definitions, commands);
        draw_thumbnails(model, surface, commands);
        draw_views(model, surface, commands);
        draw_sound(model.sound, commands);
        draw_lenses(model, commands);
    }
    if (!ImGui::IsWindowHovered() && !ImGui::IsAnyItemActive())
        row.reset();
    ImGui::End();
    if (row)
        draw_front(*model.front, surface, {at.x + size.x + margin, *row});
}

float draw_time_bar(Model& model, const Surface& surface, Commands& commands) {
    const auto width = float(surface.extent.width);
    ImGui::SetNextWindowPos({0, float(surface.extent.height)}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, float(surface.extent.height)});
    ImGui::Begin("Time", nullptr, k_bare_panel | ImGuiWindowFlags_NoMove);
    if (model.time.stepping)
        draw_stepping(model.time, commands);
    else
        draw_clock(model.time, surface, commands);
    draw_status(model);
    const float height = ImGui::GetWindowHeight();
    ImGui::End();
    return height;
}

} // namespace tidemark::overlay
