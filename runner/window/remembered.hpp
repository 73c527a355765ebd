// The state that a window saves for the next window of the same scene, in a file in the user's state folder
// ($XDG_STATE_HOME/tidemark, else ~/.local/state/tidemark). Only `view` reads it.
#pragma once

#include "host/moment.hpp"
#include "window/midi.hpp"
#include "window/picture_view.hpp"
#include "window/window.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

struct Remembered {
    std::optional<Moment> moment{}; ///< last on show: its knobs, camera and time are used
    std::optional<platform::WindowPlace> place{};
    std::optional<RenderScale> scale{};
    bool controls_open = false;
    std::vector<Moment> views{};
    std::vector<live::Binding> controllers{}; ///< bindings of a MIDI device
};

/// Returns the saved state. Returns nothing where there is none, or where it cannot be used, which is
/// reported in a line.
std::optional<Remembered> recall(const std::filesystem::path& scene);

/// Writes the state, completely or not at all; prints a line if it cannot be written.
void remember(const std::filesystem::path& scene, const Remembered& state);

/// Returns a summary for the user: `height = 2, camera 70,10,4, 2.500 s, 3 views`.
std::string words_of(const Remembered& state);

} // namespace tidemark::cli
