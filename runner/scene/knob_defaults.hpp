// Values of knobs written into the `#iUniform` lines that declare them. Text in, text out: reads and writes
// no file.
#pragma once

#include "base/result.hpp"
#include "scene/knob.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::scene {

/// The text of a file with the value of each of these knobs as its default; nothing else in it changes. Fails
/// (ErrorCode::write) where it does not declare one of them.
Result<std::string> with_defaults(std::string_view text, const std::vector<Knob>& knobs);

} // namespace tidemark::scene
