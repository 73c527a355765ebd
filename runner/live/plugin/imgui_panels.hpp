// The panels, drawn by Dear ImGui through its OpenGL 3 back end. Only one object may exist at a time.
#pragma once

#include "live/event_owner.hpp"
#include "live/plugin/panels.hpp"

#include <chrono>

struct ImFont;

namespace tidemark::live {

class ImGuiPanels : public Panels {
public:
    ImGuiPanels();
    ~ImGuiPanels() override;
    ImGuiPanels(const ImGuiPanels&) = delete;
    ImGuiPanels& operator=(const ImGuiPanels&) = delete;

    void show(Model model, const Surface& surface) override;
    bool take(const platform::InputEvent& event) override;
    void draw() override;
    Commands take_commands() override;
    void release_all() override;

private:
    void run();
    void adopt(double scale);

    Model model_;
    Surface surface_{{1, 1}, 0};
    ImFont* large_ = nullptr;
    Commands commands_;
    EventOwner owner_;
    std::chrono::steady_clock::time_point ran_at_ = std::chrono::steady_clock::now();
};

} // namespace tidemark::live
