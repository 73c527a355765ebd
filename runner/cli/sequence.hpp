// Pictures that were made before: one file, or all files of a numbered sequence.
#pragma once

#include "base/result.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string_view>

namespace tidemark::cli {

class OutputName;

/// The number of the frame that has this file's name by `pattern`: one of the runs of digits in it.
std::optional<int> frame_of(const std::filesystem::path& file, const OutputName& pattern);

/// By frame number, ascending; a single file has the key nullopt.
using Sequence = std::map<std::optional<int>, std::filesystem::path>;

/// What `name` stands for: a file, or the files that are there of `wave.%04d.png` or `wave.####.png`. Fails
/// (ErrorCode::load) when there is none, and (ErrorCode::usage) on a form we do not write.
Result<Sequence> find_sequence(std::string_view name);

} // namespace tidemark::cli
