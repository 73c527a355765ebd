#include "live/plugin/time_bar.hpp"

#include "live/plugin/text.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace tidemark::live {
namespace {

void draw_stepping(const Stepping& stepping, Commands& commands) {
    const std::string text = fmt::format("frame {} of {}", stepping.frame, stepping.last);
    if (ImGui::Button("Give up"))
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
    const double end = bar_end(time);
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    const ImGuiID typed = ImGui::GetID("typed time");
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderScalar("##time", ImGuiDataType_Double, &time.seconds, &k_begin, &end, "%.2f s")) {
        const double wanted = std::max(time.seconds, 0.0);
        if (ImGui::IsMouseDown(ImGuiMouseButton_Left) && !ImGui::GetIO().WantTextInput)
            commands.emplace_back(Seek{wanted});
        else
            kept.SetFloat(typed, float(wanted));
    }
    if (!ImGui::IsItemDeactivated())
        return;
    const bool taken_back = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
    if (const float wanted = kept.GetFloat(typed, k_nothing); wanted >= 0 && !taken_back)
        commands.emplace_back(Seek{wanted});
    kept.SetFloat(typed, k_nothing);
}

void draw_clock(TimeField& time, Commands& commands) {
    if (ImGui::Button("|<"))
        commands.emplace_back(Restart{});
    ImGui::SameLine();
    if (ImGui::Button(time.paused ? "Play###pause" : "Pause###pause"))
        commands.emplace_back(TogglePause{});
    ImGui::SameLine();
    draw_loop(time, commands);
    ImGui::SameLine();
    if (time.has_speed) {
        draw_speed(time, commands);
        ImGui::SameLine();
    }
    draw_scrubber(time, commands);
}

void draw_status(const Model& model) {
    std::string text = fmt::format("{:.3f} s  frame {}  {}x{}", model.time.seconds, model.time.frame,
                                   model.extent.width, model.extent.height);
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

float draw_time_bar(Model& model, const Surface& surface, Commands& commands) {
    const auto width = float(surface.extent.width);
    ImGui::SetNextWindowPos({0, float(surface.extent.height)}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, float(surface.extent.height)});
    constexpr auto k_plain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                             ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing;
    ImGui::Begin("Time", nullptr, k_plain);
    if (model.time.stepping)
        draw_stepping(*model.time.stepping, commands);
    else
        draw_clock(model.time, commands);
    draw_status(model);
    const float height = ImGui::GetWindowHeight();
    ImGui::End();
    return height;
}

} // namespace tidemark::live
