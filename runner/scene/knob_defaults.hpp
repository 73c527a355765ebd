// Writes values of knobs into the `#iUniform` lines that declare them. Text in, text out: reads and writes no
// files.
#pragma once

#include "base/result.hpp"
#include "scene/knob.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::scene {

/// Returns the text of a file with the value of each of these knobs as its default; nothing else changes.
/// Fails (ErrorCode::write) if it does not declare one of them.
Result<std::string> with_defaults(std::string_view text, const std::vector<Knob>& knobs);

} // namespace tidemark::scene
