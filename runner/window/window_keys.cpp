#include "window/window_keys.hpp"

#include "scene/host_uniforms.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::window {
namespace {

using host::Key;

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
    {"C; K", "copy the command that captures this moment; keep it as a view"},
    {"Alt+1 to Alt+9", "go to a view"},
    {"-, =; A", "render scale: half, double, from 1/8 to 2; adaptive: it holds a frame rate"},
    {"Ctrl+Shift+C; Ctrl+R", "copy the picture; record a video of it (SCENE.mp4), until pressed again"},
    {"Z, X", "freeze the picture, while time goes on"},
    {"Ctrl+Z; Ctrl+Y", "undo, redo changes of knobs, definitions, views and camera"},
    {"U; up, down", "mute the sound; louder, quieter"},
    {"Backspace; PageUp, PageDown", "of several scenes: all of them; the one before, the next"},
    {"L; Shift+L", "lens: the next, the one before: cost, steps, error, rounding, proof, clocks, off"},
    {"I; F; H, F1", "status line: frame time, error, rays, NaN; full screen; help"},
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

bool reads_camera(const render::Renderer& renderer) {
    return std::ranges::any_of(renderer.plan().passes, [&](const render::PlannedPass& planned) {
        const bool other_hosts = renderer.names_of(planned.pass).other_hosts;
        return std::ranges::any_of(
            renderer.program(planned.pass).reflection().uniforms, [&](const gl::Uniform& uniform) {
                const scene::HostUniform* row = scene::find_host_uniform(uniform.name, other_hosts);
                return row && row->follows == scene::Follows::camera;
            });
    });
}

WindowKeys::Owner WindowKeys::press(const host::KeyPressed& event, bool scene_reads) {
    const bool is_control = event.key == Key::control;
    const bool is_digit = event.key >= Key::digit_0 && event.key <= Key::digit_9;
    const bool ours = (control_down_ && !is_control) || (alt_down_ && is_digit) || event.key == Key::escape ||
                      event.key == Key::f1 || !scene_reads;
    control_down_ |= is_control;
    alt_down_ |= event.key == Key::alt;
    shift_down_ |= event.key == Key::shift;
    const bool repeats =
        event.key == Key::left || event.key == Key::right || event.key == Key::up || event.key == Key::down;
    if (!event.repeat && ours)
        obeyed_.insert(event.key);
    if (obeyed_.contains(event.key))
        return !event.repeat || repeats ? Owner::window : Owner::nobody;
    return event.repeat || ours ? Owner::nobody : Owner::scene;
}

WindowKeys::Owner WindowKeys::release(const host::KeyReleased& event) {
    if (event.key == Key::control)
        control_down_ = false;
    if (event.key == Key::alt)
        alt_down_ = false;
    if (event.key == Key::shift)
        shift_down_ = false;
    return obeyed_.erase(event.key) == 0 ? Owner::scene : Owner::nobody;
}

} // namespace tidemark::window
