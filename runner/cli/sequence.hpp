// Finds existing pictures: one file, or all files of a numbered sequence.
#pragma once

#include "base/result.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string_view>

namespace tidemark::cli {

class OutputName;

/// Returns the frame number in a file's name, if the name fits the pattern: one of its runs of digits.
std::optional<int> frame_of(const std::filesystem::path& file, const OutputName& pattern);

/// By frame number, ascending; a single file has the key nullopt.
using Sequence = std::map<std::optional<int>, std::filesystem::path>;

/// Finds the files of `name`: one file, or all existing files of `wave.%04d.png` or `wave.####.png`. Fails
/// (ErrorCode::load) if there is none, and (ErrorCode::usage) on an unknown pattern.
Result<Sequence> find_sequence(std::string_view name);

} // namespace tidemark::cli
