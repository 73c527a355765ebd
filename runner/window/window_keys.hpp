// Keys in the window: the table of their effects, and the owner of each pressed key.
#pragma once

#include "host/input_events.hpp"
#include "render/renderer.hpp"

#include <set>
#include <span>
#include <string>
#include <string_view>

namespace tidemark::window {

/// An input and its effect, as shown in the terminal, in the overlay and in the manual.
struct KeyRow {
    std::string_view keys;
    std::string_view meaning;
};
std::span<const KeyRow> key_rows();

/// The text below the rows.
inline constexpr std::string_view k_keys_of_scenes =
    "A scene that reads the keyboard gets all keys but Esc and F1: hold Ctrl for the above, X for Z, "
    "Ctrl+Shift+R for R.";

/// Returns the rows in two columns, for a terminal.
std::string key_table();

/// Returns whether the scene reads the keyboard.
bool reads_keyboard(const render::Renderer& renderer);
/// Returns whether a program of the scene reads the orbit camera.
bool reads_camera(const render::Renderer& renderer);

/// Assigns each key to the scene or the window, and its release like its press. Ctrl goes to the scene; keys
/// that are pressed while it is down go to the window, and so do digits with Alt.
class WindowKeys {
public:
    enum class Owner { scene, window, nobody };
    /// `scene_reads`: the scene gets all keys but Esc, F1 and those with Ctrl.
    Owner press(const host::KeyPressed& event, bool scene_reads);
    Owner release(const host::KeyReleased& event);
    bool control_down() const { return control_down_; }
    bool alt_down() const { return alt_down_; }
    bool shift_down() const { return shift_down_; }

private:
    std::set<host::Key> obeyed_; ///< keys that are down and were handled by the window
    bool control_down_ = false;
    bool alt_down_ = false;
    bool shift_down_ = false;
};

} // namespace tidemark::window
