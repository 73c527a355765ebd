// A file that the shards of a capture leave in their folder for `gather`: the arguments of their common
// command.
#pragma once

#include "base/output_path.hpp"
#include "base/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tidemark::cli {

inline constexpr const char* k_shard_note = "shards.json";

struct ShardNote {
    std::vector<std::string> words; ///< arguments of `tidemark capture`, without --shard, --resume and --json
    int count = 1;

    bool operator==(const ShardNote&) const = default;
};

/// Writes the note. Fails (ErrorCode::usage) if the folder has the note of another capture.
Result<void> leave_note(const OutputPath& file, const ShardNote& note);

/// Reads the note. Fails (ErrorCode::load) if there is none, or if it is not a shard note.
Result<ShardNote> read_note(const std::filesystem::path& file);

} // namespace tidemark::cli
