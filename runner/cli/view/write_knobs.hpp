// The values of knobs into the files that declare them, each of them whole or not at all.
#pragma once

#include "base/result.hpp"
#include "scene/knob.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

/// Those whose value is not their default. Gives a line for people about each file; fails (ErrorCode::write)
/// where one cannot be written, or declares no such knob any more.
Result<std::vector<std::string>> write_knobs(const std::vector<scene::Knob>& knobs);

} // namespace tidemark::cli
