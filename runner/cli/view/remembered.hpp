// What a window leaves for the next one of the same scene, in a file of the person's own state folder
// ($XDG_STATE_HOME/tidemark, else ~/.local/state/tidemark). No command but `view` reads it.
#pragma once

#include "cli/moment.hpp"
#include "live/inputs/controller_map.hpp"
#include "platform/window.hpp"
#include "render/render_scale.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

struct Remembered {
    std::optional<Moment> moment{}; ///< on show at last: its knobs, camera and time count
    std::optional<platform::WindowPlace> place{};
    std::optional<render::RenderScale> scale{};
    bool controls_open = false;
    std::vector<Moment> views{};
    std::vector<live::Binding> controllers{}; ///< of a MIDI device
};

/// Nothing where there is none, which is not said, or where it cannot be used, which is.
std::optional<Remembered> recall(const std::filesystem::path& scene);

/// Whole or not at all; where it cannot be written, a line says so.
void remember(const std::filesystem::path& scene, const Remembered& state);

/// `height = 2, camera 70,10,4, 2.500 s, 3 views`: what somebody may wonder about.
std::string words_of(const Remembered& state);

} // namespace tidemark::cli
