// What an OSC message asks of the window.
#pragma once

#include "live/command.hpp"
#include "live/inputs/osc_message.hpp"

#include <span>

namespace tidemark::live {

/// The knobs as they are turned now.
///
///     /knob/NAME v            in the knob's own units, one number for all its components or one for each;
///                             a text is read as --set reads it
///     /knob/NAME/g v          one component: x y z w, r g b a
///     /time SECONDS           iTime
///     /play 0                 pauses; 1, or nothing, goes on
///
/// ErrorCode::usage says what is wrong with another message, in a line that can be read alone.
Result<Command> osc_command(const OscMessage& message, std::span<const scene::Knob> knobs);

} // namespace tidemark::live
