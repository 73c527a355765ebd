// Translates OSC messages to commands for the window.
#pragma once

#include "live/command.hpp"
#include "live/inputs/osc_message.hpp"

#include <span>

namespace tidemark::live {

/// Returns the command for a message. `knobs` have their current values.
///
///     /knob/NAME v            in the knob's own units, one number for all its components or one for each;
///                             a text is read as --set reads it
///     /knob/NAME/g v          one component: x y z w, r g b a
///     /time SECONDS           iTime
///     /play 0                 pauses; 1, or no argument, resumes
///
/// Fails with ErrorCode::usage and a one-line message.
Result<Command> osc_command(const OscMessage& message, std::span<const scene::Knob> knobs);

} // namespace tidemark::live
