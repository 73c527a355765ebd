// Keys in the window: the table of what they do, and whose a key is that goes down.
#pragma once

#include "platform/input.hpp"
#include "render/renderer.hpp"

#include <set>
#include <span>
#include <string>
#include <string_view>

namespace tidemark::cli {

/// What people do, and what comes of it: the same rows in the terminal, in the overlay and in the manual.
struct KeyRow {
    std::string_view keys;
    std::string_view meaning;
};
std::span<const KeyRow> key_rows();

/// What stands below the rows.
inline constexpr std::string_view k_keys_of_scenes =
    "A scene that reads the keyboard gets all keys but Esc and F1: hold Ctrl for the above.";

/// The rows in two columns, for a terminal.
std::string key_table();

/// Whether keys are the scene's.
bool reads_keyboard(const render::Renderer& renderer);

/// A key is the scene's or ours, and goes as it came. Ctrl is the scene's: what follows it is ours.
class WindowKeys {
public:
    enum class Owner { scene, window, nobody };
    /// `scene_reads`: the scene has the keys to itself, but for those with Ctrl.
    Owner press(const platform::KeyPressed& event, bool scene_reads);
    Owner release(const platform::KeyReleased& event);

private:
    std::set<platform::Key> obeyed_; ///< that are down, and that the scene knows nothing of
    bool control_down_ = false;
};

} // namespace tidemark::cli
