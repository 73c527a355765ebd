#include "live/overlay.hpp"

#include "base/plug_in.hpp"
#include "base/try.hpp"

#include <utility>

namespace tidemark::live {
namespace {

/// Frames until the layout is final: sizes and hit tests lag one or two frames after a change.
constexpr int k_frames_to_settle = 3;

Result<std::unique_ptr<Panels>> load_panels() {
    const PlugIn plug_in{"tidemark_overlay.so", "overlay plug-in", "the overlay",
                         "Dear ImGui 1.86",     k_panels_entry,    k_panels_version};
    const auto* table = TRY(load_plug_in<PanelsPlugIn>(plug_in));
    return table->create();
}

} // namespace

Result<void> Overlay::show(Model model, const Surface& surface) {
    const Model::Panels open = model.panels();
    const bool visible = open != Model::Panels{} && !failed_;
    if (std::exchange(open_, open) != open)
        frames_wanted_ = k_frames_to_settle;
    if (!visible && visible_)
        panels_->release_all();
    visible_ = false;
    if (!visible)
        return {};
    if (!panels_) {
        failed_ = true;
        panels_ = TRY(load_panels());
        failed_ = false;
    }
    visible_ = true;
    panels_->show(std::move(model), surface);
    return {};
}

bool Overlay::take(const platform::InputEvent& event) {
    if (!visible_)
        return false;
    frames_wanted_ = k_frames_to_settle;
    return panels_->take(event);
}

void Overlay::draw() {
    if (!visible_)
        return;
    panels_->draw();
    --frames_wanted_;
}

Commands Overlay::take_commands() {
    return panels_ ? panels_->take_commands() : Commands{};
}

} // namespace tidemark::live
