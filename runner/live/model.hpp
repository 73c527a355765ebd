// Everything that the overlay shows, as plain values. The owner of the window makes a new one for each frame.
#pragma once

#include "live/definition_field.hpp"
#include "live/error_field.hpp"
#include "live/knob_field.hpp"
#include "live/look_field.hpp"
#include "live/magnifier_field.hpp"
#include "live/picture_field.hpp"
#include "live/time_field.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::live {

/// An input and its effect.
struct HelpRow {
    std::string keys;
    std::string meaning;
};

struct Model {
    bool controls = false; ///< the controls are open; only then everything down to `extent` is shown
    std::vector<KnobField> knobs{};
    std::vector<DefinitionField> definitions{};
    std::vector<PictureField> pictures{};
    std::optional<size_t> large{}; ///< index of the picture that is shown large
    LookField look{};              ///< how that one is viewed
    std::vector<std::string> views{};
    TimeField time{};
    Extent extent{}; ///< of the scene's picture

    std::vector<ErrorField>
        errors{};                ///< most important first; the panel is open while there are any
    std::vector<HelpRow> help{}; ///< the panel is open while there are any
    std::string help_footer{};

    std::optional<MagnifierField> magnifier{};
    std::string clock{}; ///< progress of a slow frame; empty: none is being drawn

    /// The open panels.
    using Panels = std::array<bool, 5>;
    Panels panels() const {
        return {controls, !errors.empty(), !help.empty(), magnifier.has_value(), !clock.empty()};
    }
};

} // namespace tidemark::live
