// All that the overlay shows, as plain values: made anew for every frame by whoever owns the window.
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

/// What people do, and what comes of it.
struct HelpRow {
    std::string keys;
    std::string meaning;
};

struct Model {
    bool controls = false; ///< open: then all down to `extent` is shown
    std::vector<KnobField> knobs{};
    std::vector<DefinitionField> definitions{};
    std::vector<PictureField> pictures{};
    std::optional<size_t> large{}; ///< of them
    LookField look{};              ///< at that one
    std::vector<std::string> views{};
    TimeField time{};
    Extent extent{}; ///< of what the scene draws

    std::vector<ErrorField>
        errors{};                ///< the one to mend first in front; the panel is open while there are any
    std::vector<HelpRow> help{}; ///< likewise
    std::string help_footer{};

    std::optional<MagnifierField> magnifier{};
    std::string clock{}; ///< of a frame that is drawn for long; empty: none is

    /// Which panels are open.
    using Panels = std::array<bool, 5>;
    Panels panels() const {
        return {controls, !errors.empty(), !help.empty(), magnifier.has_value(), !clock.empty()};
    }
};

} // namespace tidemark::live
