#include "window/window_keys.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::cli {
namespace {

using platform::Key;

constexpr KeyRow k_rows[] = {
    {"drag", "iMouse, and the orbit camera of scenes that declare it"},
    {"wheel, middle drag, R", "zoom, pan, reset that camera"},
    {"space; left, right", "pause; a frame back, forward"},
    {"Home; V", "restart at frame 0; speed 1"},
    {"Tab; 1 to 9, 0", "controls; in them: a pass or an input large, the scene again"},
    {"M", "magnifier: the pixels around the pointer, and what passes wrote into the one under it"},
    {"N", "marks: NaN magenta, infinity green, below zero blue"},
    {"Enter", "with the magnifier: the line where that pixel's NaN or infinity comes from"},
    {"S", "save a picture (SCENE-FRAME.png in the current folder, numbered if it exists)"},
    {"C; K", "copy the command that captures this moment; keep it in the controls"},
    {"-, =; A", "render scale: half, double, from 1/8 to 2; adaptive: it holds a frame rate"},
    {"Z, X", "freeze the picture, while time goes on"},
    {"Ctrl+Z; Ctrl+Y", "undo, redo changes of knobs, definitions, views and camera"},
    {"I; F; H, F1", "frame rate; full screen; help"},
    {"Esc", "cancel a recompilation or a frame of more than a second; else close what is open"},
    {"Esc Esc; Ctrl+Q", "quit; Esc twice within a second"},
};

} // namespace

std::span<const KeyRow> key_rows() {
    return k_rows;
}

std::string key_table() {
    const size_t width =
        std::ranges::max(k_rows, {}, [](const KeyRow& row) { return row.keys.size(); }).keys.size();
    std::string table;
    for (const KeyRow& row : k_rows)
        table += fmt::format("{:{}}  {}\n", row.keys, width, row.meaning);
    return table + std::string(k_keys_of_scenes);
}

bool reads_keyboard(const render::Renderer& renderer) {
    return std::ranges::any_of(renderer.plan().passes, [&](const render::PlannedPass& planned) {
        const scene::Channels& channels = renderer.scene().passes[planned.pass].channels;
        return planned.keyboard_helpers || std::ranges::any_of(planned.channels, [&](int channel) {
                   return traits_of(channels[size_t(channel)].input).changes == scene::Changes::with_keys;
               });
    });
}

WindowKeys::Owner WindowKeys::press(const platform::KeyPressed& event, bool scene_reads) {
    const bool is_control = event.key == Key::control;
    const bool ours =
        (control_down_ && !is_control) || event.key == Key::escape || event.key == Key::f1 || !scene_reads;
    control_down_ |= is_control;
    const bool repeats = event.key == Key::left || event.key == Key::right;
    if (!event.repeat && ours)
        obeyed_.insert(event.key);
    if (obeyed_.contains(event.key))
        return !event.repeat || repeats ? Owner::window : Owner::nobody;
    return event.repeat || ours ? Owner::nobody : Owner::scene;
}

WindowKeys::Owner WindowKeys::release(const platform::KeyReleased& event) {
    if (event.key == Key::control)
        control_down_ = false;
    return obeyed_.erase(event.key) == 0 ? Owner::scene : Owner::nobody;
}

} // namespace tidemark::cli
