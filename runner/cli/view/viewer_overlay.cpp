// The contents of the overlay, and its commands.
#include "base/shell_word.hpp"
#include "cli/console.hpp"
#include "cli/view/editor.hpp"
#include "cli/view/overlay_fields.hpp"
#include "cli/view/viewer.hpp"
#include "cli/view/write_knobs.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::cli {

/// Opens or closes the controls. An optimised program contains the knobs' values, so the text is compiled as
/// written while they may change.
void Viewer::toggle_controls() {
    controls_open_ = !controls_open_;
    stale_overlay_ = true;
    if (!controls_open_)
        return pictures_.reset();
    settled_ = false;
    scene_.stop_settling();
    if (stage_ && stage_->share() && !scene_.building_since())
        scene_.build_anew(turned_scene(), view(), LiveScene::Settle::no);
}

/// Shows a picture of the controls for digits 1 to 9; 0, or the same digit again, shows the scene's own.
void Viewer::show_picture_of(platform::Key digit) {
    if (!controls_open_ || digit < platform::Key::digit_0 || digit > platform::Key::digit_9)
        return;
    const int number = int(digit) - int(platform::Key::digit_0);
    const std::optional<size_t> index = number > 0 ? std::optional(size_t(number) - 1) : std::nullopt;
    large_ = large_ == index ? std::nullopt : index;
    stale_overlay_ = true;
}

/// Shows the help, in the terminal too, where it remains after the window.
void Viewer::toggle_help() {
    help_open_ = !help_open_;
    stale_overlay_ = true;
    if (help_open_)
        say(key_table());
}

/// Returns whether to draw the overlay without a new frame of the scene. A moving scene draws it along with
/// its frames.
bool Viewer::overlay_due() const {
    return screen_->is_watched() && (stale_overlay_ || screen_->wants_frame()) && (making_ || !moving());
}

live::Model Viewer::overlay_model() {
    live::Model model{.controls = controls_open_ && stage_,
                      .errors = errors_.fields().empty() ? origin_.fields() : errors_.fields(),
                      .magnifier = magnifier_field()};
    if (const double now = now_seconds(); draws_for_long(now)) {
        model.clock = drawing_words(now);
        clock_shown_at_ = now;
    }
    if (model.controls && !defined_)
        defined_ = definition_fields(stage_->renderer().scene(), scene_.request());
    if (model.controls) {
        const render::Renderer& renderer = stage_->renderer();
        render::FrameState turned = shown_;
        if (making_ && !replay_)
            controls_.fill(turned); // newer than the frame on show
        model.knobs = knob_fields(renderer.scene(), turned.knobs);
        if (inputs_ && inputs_->has_midi())
            add_controllers(model.knobs, controllers_);
        model.definitions = *defined_;
        look_at_pictures(model);
        model.views = view_labels(views_);
        model.time = time_field();
        model.extent = renderer.extent();
    }
    if (help_open_) {
        for (const KeyRow& row : key_rows())
            model.help.push_back({std::string(row.keys), std::string(row.meaning)});
        model.help_footer = k_keys_of_scenes;
    }
    return model;
}

void Viewer::obey_overlay() {
    for (const live::Command& command : screen_->take_commands())
        std::visit([this](const auto& wanted) { carry_out(wanted); }, command);
}

void Viewer::carry_out(const live::TurnKnob& command) {
    if (!stage_)
        return;
    const auto& knobs = stage_->renderer().scene().knobs;
    const auto knob = std::ranges::find(knobs, command.name, &scene::Knob::name);
    const auto taken = [&](double number) { return live::takes(*knob, number); };
    if (knob != knobs.end() && std::ranges::all_of(command.value, taken))
        control(KnobTurned{{command.name, to_string(*knob, command.value)}});
}

void Viewer::carry_out(const live::ResetKnob& command) {
    control(KnobTurned{{command.name, std::string(scene::k_default_value)}});
}

void Viewer::carry_out(const live::ResetKnobs&) {
    if (!stage_)
        return;
    for (const scene::Knob& knob : stage_->renderer().scene().knobs)
        if (value_after(knob, shown_.knobs) != knob.initial)
            carry_out(live::ResetKnob{knob.name});
}

void Viewer::carry_out(const live::CopyKnobs&) {
    if (!stage_)
        return;
    std::vector<std::string> words;
    for (const scene::Knob& knob : turned_scene().knobs)
        if (knob.value != knob.initial)
            words.insert(words.end(), {"--set", fmt::format("{}={}", knob.name, to_string(knob))});
    const std::string text = shell_words(words);
    screen_->set_clipboard(text);
    say(words.empty() ? "nothing to copy: every knob is as the file has it" : "copied: " + text);
}

/// Writes the knobs into their files. The reload that follows finds each at its value.
void Viewer::carry_out(const live::WriteKnobs&) {
    if (!stage_)
        return;
    auto written = write_knobs(turned_scene().knobs);
    if (!written)
        return say(to_string(written.error()));
    for (const std::string& line : *written)
        say(line);
}

void Viewer::carry_out(const live::OpenEditor& command) {
    if (auto opened = open_editor(command.where); !opened)
        say(to_string(opened.error()));
}

void Viewer::carry_out(const live::Define& command) {
    scene_.define(command.name, command.value, view());
}

void Viewer::carry_out(const live::Undefine& command) {
    scene_.define(command.name, std::nullopt, view());
}

/// Returns whether knobs may change soon, which would make a program that contains their values useless.
bool Viewer::knobs_may_turn() const {
    return controls_open_ || (inputs_ && settings_.inputs->turns_knobs()) ||
           (replay_ && turns_knobs(replay_->script()));
}

/// Returns the scene on show with the current values of its knobs.
scene::Scene Viewer::turned_scene() const {
    scene::Scene scene = stage_->renderer().scene();
    for (scene::Knob& knob : scene.knobs)
        knob.value = value_after(knob, shown_.knobs);
    return scene;
}

} // namespace tidemark::cli
