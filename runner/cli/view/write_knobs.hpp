// Writes the values of knobs into the files that declare them, each file completely or not at all.
#pragma once

#include "base/result.hpp"
#include "scene/knob.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

/// Writes the knobs that differ from their defaults. Returns a message for each file; fails
/// (ErrorCode::write) where a file cannot be written or no longer declares the knob.
Result<std::vector<std::string>> write_knobs(const std::vector<scene::Knob>& knobs);

} // namespace tidemark::cli
